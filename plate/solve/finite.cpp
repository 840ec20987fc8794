#include "plate/solve/finite.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "plate/model/numerical_error.hpp"
#include "plate/model/ranks/ranks.hpp"

namespace plate {

namespace {

void require_own(const State& state, const std::string& when) {
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

}  // namespace

void require_finite(const State& state, const std::string& when) {
  const auto* all = ranks();
  if (!all) return require_own(state, when);
  std::string wrong;
  try {
    require_own(state, when);
  } catch (const NumericalError& error) {
    wrong = "process " + std::to_string(all->rank()) + ": " + error.what();
  }
  for (const auto& one : all->exchanged(std::vector<std::string>(std::size_t(all->size()), wrong)))
    if (!one.empty()) throw NumericalError(one);
}

}  // namespace plate
