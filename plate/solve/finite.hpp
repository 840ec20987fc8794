#pragma once
#include <string>
#include "plate/model/state.hpp"

namespace plate {

/// Throws NumericalError of the first point with a displacement or rotation that is not finite; of all processes that
/// share the plate in all of them.
void require_finite(const State& state, const std::string& when);

}  // namespace plate
