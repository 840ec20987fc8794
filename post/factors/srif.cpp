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

/// The errors are at least the differences from another result, and what is added to these.
void at_least(Srif& srif, const std::array<double, 3>& other, const std::array<double, 3>& added = {}) {
  const std::array own{srif.K1, srif.K2, srif.K3};
  for (std::size_t i = 0; i < 3; ++i)
    srif.errors[i] = std::max(srif.errors[i].value_or(0), std::abs(own[i] - other[i]) + added[i]);
}

/// The smaller errors of two results.
template <std::size_t count>
std::array<double, count> smaller(const std::array<std::optional<double>, count>& one,
                                  const std::array<std::optional<double>, count>& other) {
  std::array<double, count> result{};
  for (std::size_t i = 0; i < count; ++i) result[i] = std::min(one[i].value_or(0), other[i].value_or(0));
  return result;
}

/// The errors in the plane are at least the differences from another result, and what is added to these; a factor is
/// not resolved where its error is above a tenth of the largest.
void at_least(MembraneFactors& membrane, const MembraneFactors& other, const std::array<double, 2>& added = {}) {
  const double largest = std::max(std::abs(membrane.N[0]), std::abs(membrane.N[1]));
  for (std::size_t i = 0; i < 2; ++i) {
    const double error = std::max(membrane.errors[i].value_or(0), std::abs(membrane.N[i] - other.N[i]) + added[i]);
    membrane.errors[i] = error;
    membrane.resolved[i] = membrane.resolved[i] && error <= lost * largest;
  }
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

Srif as_resolved(Srif srif) {
  srif.resolved.fill(true);
  if (srif.membrane) srif.membrane->resolved.fill(true);
  return srif;
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

double largest_with_plane(const Srif& srif, double thickness) {
  const double bending = largest_factor(srif, thickness);
  if (!srif.membrane) return bending;
  const auto& N = srif.membrane->N;
  return std::max(bending, std::max(std::abs(N[0]), std::abs(N[1])) * thickness / 6);
}

void resolve_together(Srif& srif, double thickness) {
  if (!srif.membrane) return;
  const double largest = largest_with_plane(srif, thickness);
  const auto small = [&](const std::optional<double>& error, double arm, double share) {
    return error && *error * arm <= share * largest;
  };
  const auto positive = [](const std::optional<double>& G) { return !G || *G > 0; };
  auto& plane = *srif.membrane;
  for (std::size_t i = 0; i < 3 && positive(srif.G) && !of_opening(srif.method); ++i)
    srif.resolved[i] = srif.resolved[i] ||
                       (i == 2 ? small(srif.errors[i], thickness, srif.lost_shear) : small(srif.errors[i], 1, lost));
  for (std::size_t i = 0; i < 2 && positive(plane.G); ++i)
    plane.resolved[i] = plane.resolved[i] || small(plane.errors[i], thickness / 6, lost);
}

void widen(Srif& srif, const Srif& coarser, double thickness) {
  if (srif.membrane && coarser.membrane) at_least(*srif.membrane, *coarser.membrane);
  resolve_together(srif, thickness);
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

void compare_with(Srif& srif, const Srif& other, const std::string& formulation, double thickness, bool closed) {
  const double largest = std::max(largest_factor(srif, thickness), largest_factor(other, thickness));
  const double relative = largest > 0 ? difference(srif, other, thickness) / largest : 0;
  srif.second = {formulation, other.method, other.K1, other.K2, other.K3, relative, std::nullopt};
  if (srif.membrane && other.membrane) {
    const auto &N = srif.membrane->N, &others = other.membrane->N;
    const double most = std::max({std::abs(N[0]), std::abs(N[1]), std::abs(others[0]), std::abs(others[1])});
    const double apart = std::max(std::abs(N[0] - others[0]), std::abs(N[1] - others[1]));
    srif.second->in_plane = SecondInPlane{others, most > 0 ? apart / most : 0};
    at_least(*srif.membrane, *other.membrane,
             closed ? smaller(srif.membrane->errors, other.membrane->errors) : std::array<double, 2>{});
    resolve_together(srif, thickness);
  }
  if (largest == 0) return;
  const auto added = closed ? smaller(srif.errors, other.errors) : std::array<double, 3>{};
  const double most = std::max({added[0], added[1], added[2] * thickness}) / largest;
  srif.estimated_error = std::max(srif.estimated_error.value_or(0), relative + most);
  at_least(srif, {other.K1, other.K2, other.K3}, added);
}

void add_membrane(std::vector<Srif>& bending, const std::vector<Srif>& membrane, const plate::Section& section) {
  const auto first = [](const std::vector<Srif>& all, std::size_t tip) {
    return std::ranges::find(all, tip, &Srif::tip);
  };
  for (const auto& one : membrane)
    if (first(bending, one.tip) == bending.end()) {  // no method of bending has room there
      auto& added = bending.emplace_back(one);
      added.K1 = added.K2 = 0, added.G.reset(), added.rings.clear(), added.fits.clear(), added.estimated_error.reset();
      added.errors = {}, added.resolved = {false, false, false};
    }
  for (auto& srif : bending) {
    auto found = first(membrane, srif.tip);
    if (&srif != &*first(bending, srif.tip))
      found = std::ranges::find_if(membrane,
                                   [&](const Srif& one) { return one.tip == srif.tip && one.method == srif.method; });
    if (found == membrane.end()) continue;
    if (found->accuracy_reached)
      srif.accuracy_reached = std::max(srif.accuracy_reached.value_or(0), *found->accuracy_reached);
    srif.membrane = MembraneFactors{{found->K1, found->K2},
                                    {found->errors[0], found->errors[1]},
                                    {found->resolved[0], found->resolved[1]},
                                    found->G,
                                    section.at(srif.position).thickness};
    resolve_together(srif, srif.membrane->thickness);
  }
}

namespace {

/// Moves the virtual crack extension to the front of the rows of tips that are closed at one face of the plate in a
/// layer that the points do not resolve: gradients at the points miss the energy there.
void prefer_extensions(std::vector<Srif>& srifs, const std::vector<ClosedTip>& tips) {
  std::ranges::stable_sort(srifs, {}, [&](const Srif& srif) {
    const auto& tip = tips[srif.tip];
    const bool first = !tip.layer && tip.top != tip.bottom && srif.method == SrifMethod::virtual_crack_extension;
    return std::pair(srif.tip, first ? 0 : 1);
  });
}

/// Errors of K1 and K2 where the energy `change` of K1 moves into the plane within less than the spacing. Measured with
/// 2 to 7 points in the thickness: beyond 2 % K1 is off by up to 0.1 of the change in mode 1, 0.2 beside K2.
std::array<double, 2> errors_below_layer(const Srif& srif, double K, double change) {
  constexpr double least = 0.02, opened = 0.15, mixed = 0.4, slid = 0.8;
  const double K1 = std::abs(srif.K1), K2 = std::abs(srif.K2);
  return {(opened + mixed * K2 / (K1 + K2)) * change + least * K,
          (slid * change / std::max(K1, K) + least) * K2 + least * K};
}

}  // namespace

void close(std::vector<Srif>& srifs, const std::vector<ClosedTip>& tips, const plate::Section& section) {
  constexpr double rounding = 1e-4;
  prefer_extensions(srifs, tips);
  for (auto& srif : srifs) {
    const auto& [top, bottom, scale, layer] = tips[srif.tip];
    if ((!top && !bottom) || !srif.membrane) continue;
    auto& plane = *srif.membrane;
    const double h = plane.thickness, arm = h / 6, least = rounding * arm * scale;  // N1 times the arm is |K1|
    const auto below = [&](const std::optional<double>& error) { return error.value_or(0) <= least / lost; };
    if (largest_factor(srif, h) <= least && std::ranges::all_of(srif.errors, below)) {
      srif.K1 = srif.K2 = srif.K3 = 0;
      srif.errors = {0, 0, 0}, srif.resolved = {true, true, true}, srif.estimated_error = 0;
    }
    if (top && bottom) {  // what is left is judged beside the forces that press the faces
      srif.resolved[0] = plane.resolved[0] = true;
      plane.resolved[1] = plane.resolved[1] || plane.errors[1].value_or(0) <= lost * lost * scale;
      constexpr double nothing = 1e-5;  // its energy is 1e-10 of that of the pressing forces
      if (std::max(std::abs(plane.N[1]), plane.errors[1].value_or(0)) <= nothing * scale) {
        plane.N[1] = 0;
        if (plane.G) plane.G = 0;
      }
    }
    const bool by_sum = !layer && top != bottom && srif.method == SrifMethod::virtual_crack_extension;
    if (by_sum ? srif.K1 == 0 : !srif.resolved[0] || !plane.resolved[0]) continue;
    const double N = arm * plane.N[0], shared = std::sqrt((srif.K1 * srif.K1 + 3 * N * N) / 4);
    const bool none = (top && bottom) || shared <= least;
    const double K = none ? 0 : shared, signed_K = K > 0 && top ? -K : K;
    const double change = std::max(std::abs(srif.K1 - signed_K), std::abs(N - K));
    double most = none ? 0 : std::max({srif.errors[0].value_or(0), plane.errors[0].value_or(0) * arm, change});
    if (by_sum && !none) {
      const auto errors = errors_below_layer(srif, K, change);
      const double largest = std::max(K, std::abs(srif.K2));
      most = errors[0], srif.errors[1] = errors[1];
      srif.resolved[0] = plane.resolved[0] = most <= lost * largest, srif.resolved[1] = errors[1] <= lost * largest;
      srif.estimated_error = 0;
    }
    if (section.isotropic()) {  // energies of what has changed
      const double unit = 12 * std::numbers::pi / (section.at(srif.position).young * std::pow(h, 3));
      if (srif.G) *srif.G = std::max(0.0, *srif.G + unit * (K * K - srif.K1 * srif.K1));
      if (plane.G) *plane.G = std::max(0.0, *plane.G + 3 * unit * (K * K - N * N));
    }
    if (srif.F1 && srif.K1 != 0) *srif.F1 *= signed_K / srif.K1;
    srif.K1 = signed_K, srif.errors[0] = most;
    plane.N[0] = K / arm, plane.errors[0] = most / arm;
    if (const double largest = largest_factor(srif, h); largest > 0)
      srif.estimated_error = std::max(srif.estimated_error.value_or(0), most / largest);
  }
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

using PairOfFactors = std::array<double, 2>;

struct Equivalent {
  double K;
  double height;  // over the thickness: 1/2 at the face z > 0
};

/// A norm: that of the errors bounds what they do to that of the factors. `N`: of K_I, K_II in the plane, which are the
/// same all over the thickness; where both close the crack they take no energy (theory (70)).
Equivalent equivalent(const std::array<double, 3>& K, const PairOfFactors& N, double poisson) {
  const double shear = std::abs(K[2]) / std::sqrt(1 - poisson);
  if (N == PairOfFactors{}) {
    const double bent = std::hypot(K[0], K[1]);
    return shear > bent ? Equivalent{shear, 0} : Equivalent{bent, K[0] < 0 ? -0.5 : 0.5};
  }
  constexpr int heights = 200;  // from one face to the other, with the middle
  Equivalent largest{0, 0};
  for (int i = heights; i >= 0; --i) {
    const double s = 2.0 * i / heights - 1, opening = std::max(0.0, N[0] + s * K[0]), sliding = N[1] + s * K[1];
    const double one = std::hypot(opening, sliding, (1 - s * s) * shear);
    if (one > largest.K) largest = {one, s / 2};
  }
  return largest;
}

/// K_I at z = -h/2 and z = h/2, but for a factor that both have.
PairOfFactors openings(const Srif& srif, const MembraneFactors& membrane) {
  const double bent = 6 * srif.K1 / membrane.thickness;
  return {membrane.N[0] - bent, membrane.N[0] + bent};
}

}  // namespace

Overlap overlap(const Srif& srif) {
  constexpr double nothing = 1e-6;  // of the factors of moments: rounding
  if (const auto& membrane = srif.membrane) {
    if (!srif.resolved[0] || !membrane->resolved[0]) return Overlap::unknown;
    const auto [below, above] = openings(srif, *membrane);
    const double bent = 6 * srif.errors[0].value_or(0) / membrane->thickness,
                 least = bent + std::max(membrane->errors[0].value_or(0), nothing * std::abs(membrane->N[1]));
    if (below < -least && above < -least) return Overlap::both;
    return below < -least ? Overlap::below : above < -least ? Overlap::above : Overlap::unknown;
  }
  const double size = std::abs(srif.K1), least = std::max(srif.errors[0].value_or(0), nothing * std::abs(srif.K2));
  if (!srif.resolved[0] || !(size > least)) return Overlap::unknown;
  return srif.K1 > 0 ? Overlap::below : Overlap::above;
}

const char* name_of(Overlap overlap) {
  constexpr std::array names{"", "z<0", "z>0", "both"};
  return names[std::size_t(overlap)];
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
  PairOfFactors N{}, errors_of_N{};
  if (const auto& membrane = srif.membrane) {
    auto& below = result.below.emplace();
    for (std::size_t i = 0; i < 2; ++i) {
      const double size = root / h * std::abs(membrane->N[i]), error = root / h * membrane->errors[i].value_or(0);
      if (membrane->resolved[i]) N[i] = root / h * membrane->N[i];
      errors_of_N[i] = error + (membrane->resolved[i] ? 0 : size);
      any = any || membrane->resolved[i], known = known && membrane->errors[i];
      const bool both = result.K[i] && membrane->resolved[i];
      below[i] = both ? std::optional(N[i] - K[i]) : std::nullopt;
      result.K[i] = both ? std::optional(N[i] + K[i]) : std::nullopt;
    }
  }
  if (!any || !section.isotropic()) return result;
  const double closed = 6 * std::abs(srif.K1) / h - (srif.membrane ? srif.membrane->N[0] : 0);  // over the opening
  if (srif.resolved[0]) result.overlap = std::max(0.0, 4 * closed * std::sqrt(2 * h) / (section.young * h));
  const auto most = equivalent(K, N, section.poisson);
  result.equivalent = most.K;
  result.height = most.height;
  if (known) result.error = equivalent(errors, errors_of_N, section.poisson).K;
  if (!toughness) return result;
  result.utilisation = *result.equivalent / *toughness;
  if (known) result.utilisation_error = *result.error / *toughness;
  return result;
}

}  // namespace post
