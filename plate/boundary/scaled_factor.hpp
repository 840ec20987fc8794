#pragma once
#include <Eigen/SparseLU>
#include "plate/boundary/conditions.hpp"

namespace plate {

/// The factors of a matrix that need not be symmetric, rows and columns scaled to their largest entries first: those of
/// values and of forces have other units.
class ScaledFactor {
public:
  /// @throws NumericalError  where the body is loose, or conditions contradict
  explicit ScaledFactor(const SparseStiffness& A);

  /// A^-1 b, refined once.
  /// @throws NumericalError  as the constructor
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

  std::size_t bytes() const;

private:
  Eigen::VectorXd rows_, columns_;
  SparseStiffness scaled_;
  Eigen::SparseLU<SparseStiffness> factor_;
};

}  // namespace plate
