#include "cases/driver/trust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "plate/bonds/parameters/influence.hpp"

namespace cases {
namespace {

/// Wave number of the lowest bending that the supports leave: half a wave between edges that are held, along the longer
/// side where none is.
double lowest_wave(const Case& c, const plate::Boundary& boundary) {
  const auto [low, high] = geometry::bounding_box(c.outline);
  const geometry::Point sides = high - low;
  std::array<bool, 2> held{sides.x() >= sides.y(), sides.y() >= sides.x()};
  for (const auto& side : boundary.sides) {
    if (side.kind == plate::SupportKind::free || side.kind == plate::SupportKind::symmetry) continue;
    for (const int axis : {0, 1})
      if (side.circle || side.normal_axis() == axis || side.normal_axis() < 0) held[std::size_t(axis)] = true;
  }
  return std::numbers::pi * std::hypot(held[0] / sides.x(), held[1] / sides.y());
}

/// The lowest frequency of a plate goes as (1 + (k h)^2 / 12)^(-1/2) with its rotary inertia (theory.md, "Dynamics").
void check_rotary_inertia(const Case& c, const plate::Boundary& boundary, std::vector<std::string>& warnings) {
  const double factor = c.analysis.rotary_inertia;
  if (factor == 1) return;
  const double kh = lowest_wave(c, boundary) * c.section.thickness, share = kh * kh / 12;
  const double lower = 1 - std::sqrt((1 + share) / (1 + factor * share));
  warnings.push_back(fmt::format("rotary inertia is {:g} times that of the plate: its lowest frequency is about {:.2g} % lower, those "
                                 "of shorter waves more",
                                 factor, 100 * lower));
}

/// Bending that varies over the plate locks where the horizon is much larger than the thickness (theory.md, Eq. 37).
void check_thickness(const Case& c, const plate::Boundary& boundary, std::vector<std::string>& warnings) {
  const double h = c.section.thickness, spacing = c.discretization.spacing, horizon = c.discretization.horizon();
  const double number = horizon / h * lowest_wave(c, boundary) * horizon, locking = 0.0016 * number * number;
  constexpr double trusted = 2.5;  // 1 % by Eq. 37
  if (number <= trusted) return;
  warnings.push_back(
      fmt::format("thickness is 1/{:.3g} of the spacing: (horizon/thickness) k horizon = {:.3g}, above "
                  "{:g}, with k of the longest wave between the supports: shear locking makes deflections "
                  "about {:.2g} % too small; a spacing of {:.3g} brings it to 1 %",
                  spacing / h, number, trusted, 100 * locking / (1 + locking), spacing * std::sqrt(trusted / number)));
}

/// Beside free edges, soft supports and crack faces twist and shear change within a layer of this width.
void check_edge_layer(const Case& c, const plate::Boundary& boundary, std::vector<std::string>& warnings) {
  const double horizon = c.discretization.horizon(),
               layer = c.section.thickness / std::sqrt(12 * c.section.shear_correction);
  const bool soft = std::ranges::any_of(
      boundary.sides, [](const auto& side) { return side.kind == plate::SupportKind::simply_supported; });
  if (horizon <= layer || (!soft && !c.srif)) return;
  warnings.push_back(
      fmt::format("horizon is {:.3g} times thickness / sqrt(12 shear_correction), the width of the layer in "
                  "which twist and shear change: {} not resolved above 1",
                  horizon / layer,
                  !soft    ? "K3 is"
                  : c.srif ? "K3 and soft supports are"
                           : "soft supports are"));
}

/// The same for the Galerkin plate: K3 of a twisted plate is 7 % off with 3.8 spacings in the layer, 1.1 % with 7.9.
void check_layer_spacing(const Case& c, std::vector<std::string>& warnings) {
  const double spacing = c.discretization.tip_spacing.value_or(c.discretization.spacing),
               layer = c.section.thickness / std::sqrt(12 * c.section.shear_correction);
  if (!c.srif || spacing <= layer / 6) return;
  warnings.push_back(fmt::format("spacing at the tips is {:.2g} times thickness / sqrt(12 shear_correction), the width of the layer "
                                 "in which twist and shear change: K3 needs a sixth of it or less",
                                 spacing / layer));
}

/// What the full lattice family makes of the bending stiffness: D11 / D - 1 (theory.md, Eqs. 14-16).
double anisotropy(const plate::Section& section, const plate::Discretization& d) {
  double fourth = 0, twist = 0;
  for (const auto& xi : plate::full_family(d)) {
    const double weight = plate::influence(d.influence, xi.norm(), d.horizon()) * plate::volume_share(d, xi);
    fourth += weight * std::pow(xi.x(), 4) / xi.squaredNorm();
    twist += weight * std::pow(xi.x() * xi.y(), 2) / xi.squaredNorm();
  }
  const double excess = fourth / (3 * twist) - 1;
  if (d.twist_match == plate::TwistMatch::paper) return 0.75 * (1 - section.poisson) * excess;
  return 1.5 * (1 - section.poisson) * excess / (3 * excess + 4);
}

void check_isotropy(const Case& c, std::vector<std::string>& warnings) {
  using enum plate::SurfaceCorrection;
  const auto& d = c.discretization;
  if (d.surface_correction != none && d.surface_correction != volume && d.surface_correction != arbitrary_horizon)
    return;
  constexpr double trusted = 0.01;
  const double off = anisotropy(c.section, d);
  if (std::abs(off) <= trusted) return;
  warnings.push_back(
      fmt::format("the lattice is not isotropic at horizon_ratio {:g}: bending stiffness D11 is {:+.2g} % "
                  "off; volume_correction = \"lattice_fitted\" removes this",
                  d.horizon_ratio, 100 * off));
}

void check_oblique_edges(const Case& c, const plate::Boundary& boundary, std::vector<std::string>& warnings) {
  const double usual = error_of_stairs(c, boundary);
  if (usual == 0) return;
  warnings.push_back(fmt::format("edges oblique to the lattice are stairs of the spacing for bonds: deflections come out too large, usually by some {:.1g} %, "
                                 "by far more where parts between edges and cracks are narrow; the Galerkin plate (formulation = \"galerkin\") "
                                 "follows them",
                                 100 * usual));
}

/// What the apparent toughness was measured for, and what bonds cannot do.
void check_bonds(const Case& c, const plate::Boundary& boundary, std::vector<std::string>& warnings) {
  const double h = c.section.thickness / c.discretization.spacing, m = c.discretization.horizon_ratio;
  const bool curvature = c.growth->criterion == fracture::Growth::Criterion::curvature_shear;
  const bool measured = curvature ? h >= 1.2 && h <= 15 && m >= 3 && m <= 3.1 : h >= 0.4 && h <= 50 && m >= 2.9 && m <= 5.1;
  if (!c.growth->apparent_toughness && c.growth->fracture_energy > 0 && (!measured || c.section.poisson < 0))
    warnings.push_back(fmt::format("apparent toughness of bonds: not measured, or beyond a tenth, at a thickness of {:.3g} spacings, a horizon "
                                   "of {:.3g} spacings and a Poisson's ratio of {:g} (plate/theory.md, \"Apparent toughness\")",
                                   h, m, c.section.poisson));
  if (std::ranges::any_of(boundary.sides, [](const auto& side) { return side.kind == plate::SupportKind::symmetry; }))
    warnings.push_back("bonds across a line of symmetry do not break: no crack crosses it");
}

}  // namespace

/// 61 random polygons with cracks and holes, 1/80 of the side: deflections 3.7 % too large in the median, a tenth of them 13 % or more,
/// one 80 %; falling with the spacing. The Galerkin plate on such points: 0.2 %.
double error_of_stairs(const Case& c, const plate::Boundary& boundary) {
  const bool oblique = std::ranges::any_of(boundary.sides, [](const auto& side) { return !side.circle && side.normal_axis() < 0; });
  if (!oblique || c.discretization.formulation == plate::Formulation::galerkin) return 0;
  const auto [low, high] = geometry::bounding_box(c.outline);
  return 3 * c.discretization.spacing / (high - low).minCoeff();
}

void warn_of_distrust(const Case& c, const plate::Boundary& boundary, std::vector<std::string>& warnings) {
  if (c.discretization.formulation == plate::Formulation::galerkin) {
    check_layer_spacing(c, warnings);
    check_rotary_inertia(c, boundary, warnings);
    return;
  }
  check_thickness(c, boundary, warnings);
  check_edge_layer(c, boundary, warnings);
  check_isotropy(c, warnings);
  check_oblique_edges(c, boundary, warnings);
  check_rotary_inertia(c, boundary, warnings);
  if (c.growth && c.growth->by_bonds()) check_bonds(c, boundary, warnings);
}

namespace {

/// "K2 (4.1 %), K3 (12 %)": those that are, with their estimated errors as shares of the largest factor.
template <typename Which>
std::string named(const post::Srif& srif, double thickness, double largest, const Which& which) {
  std::string result;
  for (std::size_t i = 0; i < 3; ++i) {
    const double share = srif.errors[i].value_or(0) * (i == 2 ? thickness : 1) / largest;
    if (which(i, share)) result += fmt::format("{}K{} ({:.2g} %)", result.empty() ? "" : ", ", i + 1, 100 * share);
  }
  return result;
}

/// What would resolve the layer in which K2 and K3 live.
std::string remedy(const Case& c) {
  const auto& d = c.discretization;
  const double layer = c.section.thickness / std::sqrt(12 * c.section.shear_correction);
  if (d.formulation == plate::Formulation::galerkin)
    return fmt::format("take discretization.spacing or tip_spacing = {:.2g}",
                       std::min(layer / 3, d.tip_spacing.value_or(d.spacing) / 2));
  return fmt::format("take discretization.spacing = {:.2g}, or the Galerkin plate (formulation = \"galerkin\")",
                     std::min(layer / 2 / d.horizon_ratio, d.spacing / 2));
}

}  // namespace

void warn_of_factors(const Case& c, const std::vector<post::Srif>& srifs, const std::vector<double>& largest,
                     std::vector<std::string>& warnings) {
  constexpr double uncertain = 0.03;
  const double h = c.section.thickness;
  for (std::size_t i = 0; i < srifs.size(); ++i) {
    const auto& srif = srifs[i];
    if (i > 0 && srifs[i - 1].tip == srif.tip) continue;
    const auto place = fmt::format("tip {} at ({:.4g}, {:.4g})", srif.tip, srif.position.x(), srif.position.y());
    if (srif.G && *srif.G <= 0 && !srif.resolved[0]) {
      warnings.push_back(fmt::format("{}: no intensity factors, because the energy release rate comes out as {:.3g}, which is not "
                                     "positive; {}",
                                     place, *srif.G, remedy(c)));
      continue;
    }
    const double scale = std::max(post::largest_factor(srif, h), srif.tip < largest.size() ? largest[srif.tip] : 0);
    if (scale == 0) continue;
    if (post::of_opening(srif.method) && !srif.resolved[0]) {
      warnings.push_back(fmt::format("{}: no intensity factors: too few points about it for any method but the opening of the crack, "
                                     "for which nothing vouches there; refine",
                                     place));
      continue;
    }
    const auto lost = named(srif, h, scale, [&](std::size_t k, double) { return !srif.resolved[k]; });
    const auto doubtful = named(srif, h, scale, [&](std::size_t k, double share) { return srif.resolved[k] && share > uncertain && !srif.accuracy_reached; });
    if (!lost.empty())
      warnings.push_back(fmt::format("{}: not resolved are {} (estimated error of the largest factor); {}", place, lost, remedy(c)));
    if (!doubtful.empty())
      warnings.push_back(fmt::format("{}: uncertain are {} (estimated error of the largest factor); {}", place, doubtful, remedy(c)));
  }
}

}  // namespace cases
