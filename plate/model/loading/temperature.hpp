#pragma once
#include <Eigen/Core>

#include "plate/model/loads.hpp"

namespace plate {

struct Problem;
struct Section;

/// kappa_0 = alpha (temperature at z = h/2 less that at z = -h/2) / h: the curvature in all directions that the plate
/// would take if nothing hindered it, psi = -kappa_0 (x, y), theory (78) [1 / length], at the first `count` positions.
/// Empty of other loads. Throws FormulaError.
Eigen::VectorXd free_curvature(const Load& load, const Section& section, const std::vector<geometry::Point>& positions,
                               std::size_t count);

/// Does a temperature load the plate?
bool heated(const Problem& problem);

}  // namespace plate
