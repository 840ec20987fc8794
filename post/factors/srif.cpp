#include "post/factors/srif.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "plate/model/section.hpp"

namespace post {
namespace {

double difference(const Srif& a, const Srif& b, double thickness) {
  return std::max({std::abs(a.K1 - b.K1), std::abs(a.K2 - b.K2), std::abs(a.K3 - b.K3) * thickness});
}

/// The errors are at least the differences from another result.
void at_least(Srif& srif, const std::array<double, 3>& other) {
  const std::array own{srif.K1, srif.K2, srif.K3};
  for (std::size_t i = 0; i < 3; ++i)
    srif.errors[i] = std::max(srif.errors[i].value_or(0), std::abs(own[i] - other[i]));
}

constexpr std::array<std::pair<SrifMethod, const char*>, 7> names_of_methods{
    {{SrifMethod::virtual_crack_extension, "virtual_crack_extension"},
     {SrifMethod::domain_integral, "domain_integral"},
     {SrifMethod::series_fit, "series_fit"},
     {SrifMethod::displacement_extrapolation, "displacement_extrapolation"},
     {SrifMethod::opening_series, "opening_series"},
     {SrifMethod::opening, "opening"},
     {SrifMethod::refinement, "refinement"}}};

}  // namespace

const char* name_of(SrifMethod method) {
  const auto found = std::ranges::find(names_of_methods, method, &std::pair<SrifMethod, const char*>::first);
  return found->second;
}

std::optional<SrifMethod> srif_method(const std::string& name) {
  for (const auto& [method, known] : names_of_methods)
    if (name == known) return method;
  return std::nullopt;
}

bool of_opening(SrifMethod method) {
  return method == SrifMethod::displacement_extrapolation || method == SrifMethod::opening_series;
}

std::vector<const Srif*> recommended(const std::vector<Srif>& srifs) {
  std::vector<const Srif*> result;
  for (const auto& one : srifs)
    if (result.empty() || result.back()->tip != one.tip) result.push_back(&one);
  return result;
}

double largest_factor(const Srif& srif, double thickness) {
  return std::max({std::abs(srif.K1), std::abs(srif.K2), std::abs(srif.K3) * thickness});
}

void widen(Srif& srif, const Srif& coarser, double thickness) {
  const double largest = largest_factor(srif, thickness);
  if (largest == 0) return;
  srif.estimated_error = std::max(srif.estimated_error.value_or(0), difference(srif, coarser, thickness) / largest);
  at_least(srif, {coarser.K1, coarser.K2, coarser.K3});
}

void widen(Srif& srif, double error, double thickness) {
  for (std::size_t i = 0; i < 3; ++i)
    if (srif.errors[i]) *srif.errors[i] += i == 2 ? error / thickness : error;
  const double largest = largest_factor(srif, thickness);
  if (srif.estimated_error && largest > 0) *srif.estimated_error += error / largest;
}

void compare_with(Srif& srif, const Srif& other, const std::string& formulation, double thickness) {
  const double largest = std::max(largest_factor(srif, thickness), largest_factor(other, thickness));
  const double relative = largest > 0 ? difference(srif, other, thickness) / largest : 0;
  srif.second = {formulation, other.method, other.K1, other.K2, other.K3, relative};
  if (largest == 0) return;
  srif.estimated_error = std::max(srif.estimated_error.value_or(0), relative);
  at_least(srif, {other.K1, other.K2, other.K3});
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
