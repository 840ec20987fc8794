#include "plate/solve/finite.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "plate/model/numerical_error.hpp"

namespace plate {

void require_finite(const State& state, const std::string& when) {
  constexpr std::array names{"w", "theta_x", "theta_y"};
  const Eigen::Index points = state.cols();
  Eigen::Index first = points;
#pragma omp parallel for schedule(static) reduction(min : first)
  for (Eigen::Index k = 0; k < points; ++k)
    if (!state.col(k).allFinite()) first = std::min(first, k);
  if (first == points) return;
  std::size_t component = 0;
  while (std::isfinite(state(Eigen::Index(component), first))) ++component;
  throw NumericalError(std::string(names[component]) + " of point " + std::to_string(first) + " is not finite " + when,
                       std::size_t(first));
}

}  // namespace plate
