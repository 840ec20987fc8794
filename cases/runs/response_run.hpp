#pragma once
#include "post/files/summary.hpp"

namespace cases {

class Outputs;
struct ValidatedPlate;

/// Computes the harmonic (steady-state) response of a damped plate under loads that vary as cos(2 pi f t), at every
/// frequency f of a sweep: factors, probes and reactions at each, and a period in eight frames where the deflection is
/// largest. Throws as carry_out().
post::Summary run_response(const ValidatedPlate& ready, Outputs& outputs);

}  // namespace cases
