#include "post/factors/srif.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace post {
namespace {

/// A norm: that of the errors bounds what they do to that of the factors.
double equivalent(const std::array<double, 3>& K, double poisson) {
  return std::max(std::hypot(K[0], K[1]), std::abs(K[2]) / std::sqrt(1 - poisson));
}

}  // namespace

Overlap overlap(const Srif& srif) {
  constexpr double nothing = 1e-6;  // of the factors of moments: rounding
  const double size = std::abs(srif.K1), least = std::max(srif.errors[0].value_or(0), nothing * std::abs(srif.K2));
  if (!srif.resolved[0] || !(size > least)) return Overlap::unknown;
  return srif.K1 > 0 ? Overlap::below : Overlap::above;
}

const char* name_of(Overlap overlap) {
  return overlap == Overlap::below ? "z<0" : overlap == Overlap::above ? "z>0" : "";
}

FaceFactors at_faces(const Srif& srif, const plate::Section& everywhere, std::optional<double> toughness) {
  if (!everywhere.plies.empty()) return {};
  const plate::Section section = everywhere.at(srif.position);
  const double h = section.thickness, root = std::sqrt(std::numbers::pi);
  const double bending = root * 6 / (h * h), shear = root * 3 / (2 * h);
  const std::array factor{bending, bending, shear}, own{srif.K1, srif.K2, srif.K3};
  FaceFactors result;
  std::array<double, 3> K{}, errors{};
  bool any = false, known = true;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!srif.resolved[i]) {  // it may be anything up to this
      if (srif.errors[i]) errors[i] = factor[i] * (std::abs(own[i]) + *srif.errors[i]);
      continue;
    }
    result.K[i] = K[i] = factor[i] * own[i];
    any = true, known = known && srif.errors[i];
    errors[i] = factor[i] * srif.errors[i].value_or(0);
  }
  if (!any || !section.isotropic()) return result;
  if (srif.resolved[0]) result.overlap = 24 * std::abs(srif.K1) * std::sqrt(2 * h) / (section.young * h * h);
  result.equivalent = equivalent(K, section.poisson);
  if (known) result.error = equivalent(errors, section.poisson);
  if (!toughness) return result;
  result.utilisation = *result.equivalent / *toughness;
  if (known) result.utilisation_error = *result.error / *toughness;
  return result;
}

}  // namespace post
