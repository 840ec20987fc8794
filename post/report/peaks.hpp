#pragma once
#include "post/files/summary.hpp"

namespace post {

/// Where a motion was largest: K1, K2, K3 and, with a toughness, its utilisation, of every tip by its recommended
/// method, where they are resolved; none of a quantity that may be larger where it is not. `rows` of factors at
/// `times`.
std::vector<Peak> peaks(const std::vector<double>& times, const std::vector<std::vector<Srif>>& rows,
                        const plate::Section& section, std::optional<double> toughness);

}  // namespace post
