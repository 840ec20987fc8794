#pragma once
#include <optional>
#include "plate/boundary/conditions.hpp"
#include "plate/solve/matrices/general_factor.hpp"

namespace plate {

/// The factors of a matrix that need not be symmetric, rows and columns scaled to their largest entries first: those of
/// values and of forces have other units.
class ScaledFactor {
public:
  /// @throws NumericalError  where the body is loose, or conditions contradict
  explicit ScaledFactor(const SparseStiffness& A);

  /// A^-1 b.
  /// @throws NumericalError  as the constructor
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

  std::size_t bytes() const;

private:
  Eigen::VectorXd rows_, columns_;
  std::optional<GeneralFactor> factor_;  // none of an empty matrix
};

}  // namespace plate
