#pragma once
#include <Eigen/Dense>

#include "plate/formulation/operator.hpp"

namespace spring_chain {

using namespace plate;

/// A chain of springs between walls, each point with its w only.
class Chain : public Operator {
public:
  explicit Chain(Eigen::Index points) : stiffness_(Eigen::MatrixXd::Zero(points, points)) {
    for (Eigen::Index i = 0; i < points; ++i) {
      stiffness_(i, i) = 2;
      if (i > 0) stiffness_(i, i - 1) = stiffness_(i - 1, i) = -1;
    }
  }
  std::size_t points() const override { return std::size_t(stiffness_.rows()); }
  void internal_force(const State& state, Forces& forces) const override {
    forces = Forces::Zero(3, state.cols());
    forces.row(0) = -(stiffness_ * state.row(0).transpose()).transpose();
  }
  void absolute_product(const State& state, Forces& forces) const override {
    forces = Forces::Zero(3, state.cols());
    forces.row(0) = (stiffness_.cwiseAbs() * state.row(0).transpose()).transpose();
  }
  Forces diagonal() const override {
    Forces result = Forces::Zero(3, stiffness_.rows());
    result.row(0).setConstant(2);
    return result;
  }
  const Eigen::MatrixXd& matrix() const { return stiffness_; }

private:
  Eigen::MatrixXd stiffness_;
};

class Inverse : public Preconditioner {
public:
  explicit Inverse(const Chain& chain) : inverse_(chain.matrix().inverse()) {}
  void apply(const Forces& residual, State& result) const override {
    result = State::Zero(3, residual.cols());
    result.row(0) = (inverse_ * residual.row(0).transpose()).transpose();
  }
  std::size_t bytes() const override { return 0; }

private:
  Eigen::MatrixXd inverse_;
};

}  // namespace spring_chain
