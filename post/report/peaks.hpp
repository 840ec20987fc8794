#pragma once
#include "post/files/summary.hpp"
#include "post/files/table.hpp"

namespace post {

/// Where a motion was largest: of K1, K2 and K3 of every tip by its recommended method, where they are resolved, and of
/// the deflection. `rows` of factors at `times`; `history` has the columns time and max_abs_w.
std::vector<Peak> peaks(const std::vector<double>& times, const std::vector<std::vector<Srif>>& rows,
                        const Table& history);

/// Where plates bend farther than small deflections reach, by a history with max_abs_w. What is linear may be scaled in
/// cases without units; in SI units the deflection is the plate's own.
std::vector<std::string> distrust_of_deflection(const Table& history, double thickness);

}  // namespace post
