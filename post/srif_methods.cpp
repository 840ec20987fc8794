#include "post/srif_methods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace post {
namespace {

/// Rings of the interaction integral stay within this many thicknesses: its unit fields grow exponentially beyond.
constexpr double interaction_reach = 0.65;
/// ... and must have this many spacings.
constexpr double least_ring = 6;

/// Factors with the energy release rate G and the mode mix of `split`: K3 as it is, K1 and K2 take the rest.
Eigen::Vector3d factors(double G, const Eigen::Vector3d& split, const plate::Section& section) {
  const Eigen::Vector3d unit = unit_release(section), share = unit.cwiseProduct(split.cwiseAbs2());
  const double bending = share[0] + share[1], rest = G - share[2];
  if (G <= 0 || share.sum() <= 0) return {0, 0, 0};
  if (bending <= 0 || rest <= 0.05 * G) return split * std::sqrt(G / share.sum());
  const double scale = std::sqrt(rest / bending);
  return {scale * split[0], scale * split[1], split[2]};
}

}  // namespace

TipMethods::TipMethods(const BondedPlate& plate, const TipPlace& place, double horizon, const SrifOptions& options)
    : tip_(place.tip), section_(plate.section), methods_(options.methods) {
  const TipFrame frame(place.tip);
  const PlateScale scale{plate.section, plate.spacing, horizon};
  const std::vector<geometry::Point> positions(plate.positions.begin(),
                                               plate.positions.begin() + std::ptrdiff_t(plate.plate_points));
  for (const auto& method : methods_) {
    if (method == "displacement_extrapolation" || method == "opening_series") {
      const auto how = method == "opening_series" ? series_fit(scale) : paper_fit(scale, options);
      openings_.emplace_back(positions, place.path, place.tip, scale, how);
      continue;
    }
    const bool moved = method == "virtual_crack_extension";
    Integral integral{method, rings(place.clear, INFINITY, plate.spacing), {}};
    if (integral.rings.empty())
      throw std::invalid_argument(fmt::format("{}: no ring of 4 spacings fits: the next edge, crack or load is {:g} away, "
                                              "{:.1f} spacings; refine, or choose displacement_extrapolation",
                                              method, place.clear, place.clear / plate.spacing));
    for (const auto& ring : integral.rings)
      integral.integrals.emplace_back(plate, place.tip, ring,
                                      moved ? moved_bonds(plate, frame, ring) : domain_integral(plate, frame, ring));
    integrals_.push_back(std::move(integral));
  }
  if (integrals_.empty()) return;
  const auto inner = rings(place.clear, interaction_reach * plate.section.thickness, plate.spacing);
  if (!inner.empty() && inner.front().outer >= least_ring * plate.spacing)
    interaction_.emplace_back(plate, place.tip, inner.front(), domain_integral(plate, frame, inner.front()));
  else
    openings_.emplace_back(positions, place.path, place.tip, scale, series_fit(scale));
}

/// K1, K2, K3 whose signs and proportions the integrals of the energy release rate take over.
Eigen::Vector3d TipMethods::split(const plate::State& state, const plate::Forces& force) const {
  if (!interaction_.empty()) return interaction_.front()(state, force).K;
  const Srif opening = openings_.back()(state);
  return {opening.K1, opening.K2, opening.K3};
}

Srif TipMethods::of(const Integral& integral, const plate::State& state, const plate::Forces& force) const {
  Srif result;
  result.position = tip_.position;
  result.method = integral.method;
  result.samples = integral.rings.size();
  const auto mix = split(state, force);
  for (std::size_t i = 0; i < integral.rings.size(); ++i) {
    const auto [G, own] = integral.integrals[i](state, force);
    const auto K = factors(G, mix, section_);
    result.rings.push_back({integral.rings[i].inner, integral.rings[i].outer, G, K[0], K[1], K[2]});
  }
  const RingSrif& first = result.rings.front();
  result.G = first.G, result.K1 = first.K1, result.K2 = first.K2, result.K3 = first.K3;
  return result;
}

std::vector<Srif> TipMethods::operator()(const plate::State& state, const plate::Forces& force) const {
  std::vector<Srif> found;
  for (const auto& method : methods_) {
    for (const auto& integral : integrals_)
      if (integral.method == method) found.push_back(of(integral, state, force));
    for (const auto& opening : openings_)
      if (auto srif = opening(state); srif.method == method) {
        found.push_back(std::move(srif));
        break;
      }
  }
  return found;
}

}  // namespace post
