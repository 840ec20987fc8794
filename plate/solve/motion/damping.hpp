#pragma once
#include <array>

#include "plate/model/solver_choices.hpp"

namespace plate {

/// What has these ratios alpha / 2 omega + beta omega / 2 of the critical damping at these two frequencies [1/time].
/// One of alpha and beta is negative where the ratios differ more than the frequencies allow.
Damping damping_of(const std::array<double, 2>& ratios, const std::array<double, 2>& frequencies);

}  // namespace plate
