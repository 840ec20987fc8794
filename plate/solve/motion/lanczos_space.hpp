#pragma once
#include <Eigen/Dense>

#include "plate/formulation/inertia.hpp"
#include "plate/formulation/operator.hpp"

namespace plate {

/// States u = P q of a held plate whose q are orthonormal with the mass. What it is made of must outlive it.
class LanczosSpace {
public:
  LanczosSpace(const Operator& plate, const Constraints& constraints, const Inertia& inertia,
               const Preconditioner& inverse);

  /// The static answer to nodal forces, as a new vector; false where it is in the space already.
  /// Throws NumericalError where conjugate gradients do not find it.
  bool add(const Forces& load);
  /// The next vector of the sequence of vector `i`: what the inverse makes of it need not be exact.
  bool add_after(Eigen::Index i);

  /// A state as a new vector; false where it is in the space already.
  bool add_state(const State& answer) { return add_state(answer, 0); }
  /// The state of the space that is nearest to a state in the measure of the mass.
  Eigen::VectorXd coordinates(const State& state) const;

  Eigen::Index size() const { return size_; }
  /// Columns, each a state flattened.
  auto vectors() const { return vectors_.leftCols(size_); }
  /// u_i K u_j
  const Eigen::MatrixXd& stiffness();

private:
  /// `coupled`: the answer is orthogonal to the vectors before this one but for rounding.
  bool add_state(const State& answer, Eigen::Index coupled);
  double norm(const Eigen::VectorXd& u) const;
  State state_of(const Eigen::VectorXd& u) const;

  const Operator& plate_;
  const Constraints& constraints_;
  const Inertia& inertia_;
  const Preconditioner& inverse_;
  Eigen::Index points_, size_ = 0;
  Eigen::MatrixXd vectors_, forces_;  // columns
  Eigen::MatrixXd stiffness_;         // of the first vectors
};

/// A state as a vector.
inline Eigen::Map<const Eigen::VectorXd> flat(const State& state) {
  return {state.data(), state.size()};
}

}  // namespace plate
