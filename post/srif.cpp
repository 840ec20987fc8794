#include "post/srif.hpp"

#include <algorithm>
#include <cmath>

namespace post {

double largest_factor(const Srif& srif, double thickness) {
  return std::max({std::abs(srif.K1), std::abs(srif.K2), std::abs(srif.K3) * thickness});
}

void widen(Srif& srif, const Srif& coarser, double thickness) {
  const double largest = largest_factor(srif, thickness);
  if (largest == 0) return;
  const double difference = std::max({std::abs(srif.K1 - coarser.K1), std::abs(srif.K2 - coarser.K2),
                                      std::abs(srif.K3 - coarser.K3) * thickness});
  srif.estimated_error = std::max(srif.estimated_error.value_or(0), difference / largest);
}

void normalize(Srif& srif, const SrifOptions& options, double thickness) {
  if (!options.normalize || !options.half_length) return;
  const Normalization& n = *options.normalize;
  const double moment = n.moment ? *n.moment : *n.pressure * std::pow(*n.width / 2, 2);
  const double unit = moment * std::sqrt(*options.half_length);
  srif.F1 = srif.K1 / unit;
  srif.F2 = srif.K2 / unit;
  srif.F3 = srif.K3 * thickness / unit;
}

}  // namespace post
