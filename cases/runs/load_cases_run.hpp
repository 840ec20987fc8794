#pragma once
#include "post/files/factor_rows.hpp"
#include "post/files/summary.hpp"

namespace cases {

class Outputs;
struct ValidatedPlate;

/// Carries out the load cases of a plan and their combinations, one after the other on a plate that is made once: the
/// number of each, from 1, stands in the place of time. Combinations are sums of states. `others`: a row for each.
/// Throws as carry_out().
post::Summary run_load_cases(const ValidatedPlate& ready, Outputs& outputs, const post::OtherFactors& others = {});

}  // namespace cases
