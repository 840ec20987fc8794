#include "plate/model/loading/temperature.hpp"

#include <algorithm>
#include <cmath>

#include "plate/model/problem.hpp"

namespace plate {

Eigen::VectorXd free_curvature(const Load& load, const Section& section, const std::vector<geometry::Point>& positions,
                               std::size_t count) {
  if (load.kind != Load::Kind::temperature) return {};
  const double each = section.thermal_expansion / section.thickness;
  if (!load.formula.given()) return Eigen::VectorXd::Constant(Eigen::Index(count), each * load.value);
  Eigen::VectorXd result(static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k) {
    const double difference = load.formula(positions[k]);
    if (!std::isfinite(difference)) throw FormulaError(load.formula, positions[k]);
    result[Eigen::Index(k)] = each * difference;
  }
  return result;
}

bool heated(const Problem& problem) {
  const auto heats = [](const Load& load) { return load.kind == Load::Kind::temperature; };
  return std::ranges::any_of(problem.loads, heats);
}

}  // namespace plate
