#include "fracture/growth/quasi_static/load.hpp"

#include <cmath>

namespace fracture {

QuasiStaticLoad::Step QuasiStaticLoad::to(double whole, double critical, double held) {
  const bool fixed = control_ == Growth::Control::displacement, follows = control_ == Growth::Control::equilibrium;
  if (first_) most_displacement_ = whole;
  const double reached = fixed ? displacement_ / whole : factor_, end = fixed ? most_displacement_ / whole : 1;
  const Step result{first_ || critical >= reached * (1 - 1e-9), !follows && critical > end};
  first_ = false;
  go_to(whole, held,
        follows ? (std::isfinite(critical) ? critical : factor_) : std::min(std::max(critical, reached), end));
  return result;
}

/// A change comes first, under constant load or at constant displacement, then the load changes in proportion to the
/// displacement; where the load follows the crack, both at once. Supports that have moved do no work in the first.
void QuasiStaticLoad::go_to(double whole, double held, double factor) {
  const double displacement = factor * whole;
  const bool fixed = control_ == Growth::Control::displacement;
  const double from = control_ == Growth::Control::load ? factor_ * whole : displacement_;
  const double factor_from = fixed ? displacement_ / whole : factor_;
  const double of_supports = factor_ * held - held_;
  ledger.external_work +=
      factor_ * (from - displacement_ - of_supports) + (factor_from + factor) / 2 * (displacement - from);
  factor_ = factor, displacement_ = displacement, held_ = factor * held;
  ledger.strain = factor * displacement / 2;
}

}  // namespace fracture
