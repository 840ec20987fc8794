#include "plate/solve/complementarity.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>

#include "plate/model/errors.hpp"

namespace plate {

Complementarity::Complementarity(const Eigen::MatrixXd& C, const Eigen::VectorXd& c, const std::vector<char>& kept,
                                 Shape shape)
    : x(Eigen::VectorXd::Zero(c.size())), rest(c), shape_(shape), kept_(kept), pressed_(kept) {
  kept_.resize(std::size_t(c.size()), 0), pressed_.resize(kept_.size(), 0);
  if (!kept.empty()) solve(C, c);
  constexpr int tries = 5;
  const std::size_t most = 100 * pressed_.size() + 100;
  std::size_t fewest = pressed_.size() + 1;
  for (int left = tries;; ++iterations) {
    const auto wrong = wrong_ones(C.diagonal(), c);
    if (wrong.empty()) return;
    if (iterations == most)
      throw NumericalError(
          "contact of crack faces: the search for what touches does not end: take a finer spacing, or remove "
          "`contact`");
    if (wrong.size() < fewest)
      fewest = wrong.size(), left = tries;
    else
      --left;
    if (left > 0)
      for (const auto i : wrong) pressed_[i] = !pressed_[i];
    else
      pressed_[wrong.back()] = !pressed_[wrong.back()];
    solve(C, c);
  }
}

/// Finds those that are pulled, or overlap without being pressed.
std::vector<std::size_t> Complementarity::wrong_ones(const Eigen::VectorXd& compliances,
                                                     const Eigen::VectorXd& c) const {
  constexpr double rounding = 1e-10;
  const double length = rounding * c.cwiseAbs().maxCoeff();
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < pressed_.size(); ++i) {
    const auto k = Eigen::Index(i);
    if (kept_[i]) continue;
    if (pressed_[i] ? x[k] * compliances[k] < -length : rest[k] < -length) result.push_back(i);
  }
  return result;
}

void Complementarity::solve(const Eigen::MatrixXd& C, const Eigen::VectorXd& c) {
  std::vector<Eigen::Index> active;
  for (std::size_t i = 0; i < pressed_.size(); ++i)
    if (pressed_[i]) active.push_back(Eigen::Index(i));
  x.setZero();
  if (!active.empty()) {
    const Eigen::MatrixXd of_active = C(active, active);
    Eigen::VectorXd forces;
    if (shape_ == Shape::mixed) {
      forces = of_active.partialPivLu().solve(-c(active));
    } else if (const Eigen::LLT<Eigen::MatrixXd> factor(of_active); factor.info() == Eigen::Success) {
      forces = factor.solve(-c(active));
    }
    if (forces.size() == 0 || !forces.allFinite())
      throw NumericalError(
          "contact of crack faces: openings do not follow from the forces on them: take a finer spacing, or remove "
          "`contact`");
    x(active) = forces;
  }
  rest = C * x + c;
  for (const auto i : active) rest[i] = 0;
}

}  // namespace plate
