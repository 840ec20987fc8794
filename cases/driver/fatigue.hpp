#pragma once
#include <vector>

#include "plate/model/section.hpp"
#include "post/files/table.hpp"

namespace cases {

/// Paris and Erdogan (1963): da/dN = coefficient (range of K)^exponent above the threshold, none below. K is the stress
/// intensity factor at the faces of the plate, K = sqrt(pi) 6 / h^2 times the moment intensity factor (whose lim
/// sqrt(2r) M has no pi) [stress length^(1/2)].
struct ParisLaw {
  double coefficient = 0;  // [length / (stress length^(1/2))^exponent]
  double exponent = 0;
  double threshold = 0;  // of the range of K
};

/// Cycles from the first length to each [lengths]: the integral of da over the rate, with the rate a power of the
/// length between two of them. Infinite from where the range is not above the threshold. Throws std::invalid_argument
/// where lengths do not ascend or are not as many as ranges, plate::NumericalError where a rate of growth is not a
/// number, or too large or small for one.
std::vector<double> cycles(const ParisLaw& law, const std::vector<double>& lengths, const std::vector<double>& ranges);

/// Cycles of loads between `ratio` times `load` and `load` (factors of the case's loads) for every tip on its way
/// through growth.csv and tips.csv: tip, length, K_range, cycles, and by the estimated errors of the load factors
/// K_range_error, cycles_least and cycles_most, empty where these are not known. The length of a crack with two tips is
/// half of it at first, and grows by what the tip itself goes. K is that of mode 1 with the same energy,
/// K^2 h / (3 E) = G. Throws std::runtime_error where no tip has moved.
post::Table fatigue(const post::Table& growth, const post::Table& tips, const plate::Section& section,
                    const ParisLaw& law, double load, double ratio);

}  // namespace cases
