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
/// Share of the second and third mode in the energy above which a tip counts as one of mixed mode.
constexpr double mixed_mode = 0.02;

/// Factors with the energy release rate G and the mode mix of `split`: K3 as it is, K1 and K2 take the rest.
Eigen::Vector3d factors(double G, const Eigen::Vector3d& split, const plate::Section& section) {
  const Eigen::Vector3d unit = unit_release(section), share = unit.cwiseProduct(split.cwiseAbs2());
  const double bending = share[0] + share[1], rest = G - share[2];
  if (G <= 0 || share.sum() <= 0) return {0, 0, 0};
  if (bending <= 0 || rest <= 0.05 * G) return split * std::sqrt(G / share.sum());
  const double scale = std::sqrt(rest / bending);
  return {scale * split[0], scale * split[1], split[2]};
}

/// Least estimate of the error: a tenth of a percent; in the Galerkin plate also its error of the first order, which is
/// the larger the fewer points lie between the tip and what is next to it (theory.md, "What `estimated_error` means").
double least_error(const BondedPlate& plate, double clear) {
  return plate.galerkin ? std::max(1e-3, 0.04 * plate.spacing / clear) : 1e-3;
}

/// Of the rings that fit [length].
double largest_radius(double clear, double spacing) {
  double result = 0;
  for (const auto& ring : rings(clear, INFINITY, spacing)) result = std::max(result, ring.outer);
  return result;
}

}  // namespace

TipMethods::TipMethods(const BondedPlate& plate, const TipPlace& place, double horizon, const SrifOptions& options)
    : tip_(place.tip), section_(plate.section), galerkin_(plate.galerkin != nullptr),
      least_error_(least_error(plate, place.clear)),
      positions_(plate.positions), methods_(options.methods),
      surroundings_(plate, centred(place.tip, plate), largest_radius(place.clear, plate.spacing)) {
  const geometry::Tip tip = centred(place.tip, plate);
  const PlateScale scale{plate.section, plate.spacing, horizon, plate.galerkin != nullptr};
  const std::vector<geometry::Point> positions(plate.positions.begin(),
                                               plate.positions.begin() + std::ptrdiff_t(plate.plate_points));
  for (const auto& method : methods_) {
    try {
      if (method == "displacement_extrapolation" || method == "opening_series") {
        const auto how = method == "opening_series" ? series_fit(scale) : paper_fit(scale, options);
        openings_.emplace_back(positions, place.path, place.tip, scale, how);
      } else {
        integrals_.push_back(integral_of(method, plate, tip, place.clear, options.first_ring_only));
      }
    } catch (const std::invalid_argument& reason) {
      left_out_.push_back(reason.what());
    }
  }
  if (left_out_.size() == methods_.size()) throw std::invalid_argument(fmt::format("{}", fmt::join(left_out_, "; ")));
  if (integrals_.empty()) return;
  double reach = interaction_reach * plate.section.thickness;
  // the Galerkin plate resolves the field in smaller rings: K3 of a twisted plate (h = 25 spacings) is 1.1 % off with an outer
  // radius of 7.5 spacings, 2 % with 16
  if (plate.galerkin) reach = std::min(reach, 7.5 * plate.spacing);
  const auto inner = rings(place.clear, reach, plate.spacing);
  if (!inner.empty() && inner.front().outer >= least_ring * plate.spacing)
    interaction_.emplace_back(plate, tip, inner.front());
  else
    mix_.emplace_back(positions, place.path, place.tip, scale, narrow_fit(scale));
}

TipMethods::Integral TipMethods::integral_of(const std::string& method, const BondedPlate& plate,
                                             const geometry::Tip& tip, double clear, bool first_ring_only) const {
  Integral result{method, rings(clear, INFINITY, plate.spacing), {}};
  if (first_ring_only && !result.rings.empty()) result.rings.resize(1);
  if (result.rings.empty())
    throw std::invalid_argument(fmt::format("{}: no ring of 4 spacings fits: the next edge, crack, bend or load is {:.1f} "
                                            "spacings away; refine",
                                            method, clear / plate.spacing));
  for (const auto& ring : result.rings)
    result.integrals.emplace_back(surroundings_, ring,
                                  method != "virtual_crack_extension" ? domain_integral(plate, TipFrame(tip), ring)
                                  : plate.galerkin                    ? moved_points(plate, TipFrame(tip), ring)
                                                                      : moved_bonds(plate, TipFrame(tip), ring));
  return result;
}

/// K1, K2, K3 whose signs and proportions the integrals of the energy release rate take over.
Eigen::Vector3d TipMethods::split(const plate::State& state, const plate::Forces& force) const {
  if (!interaction_.empty()) return interaction_.front()(state, force);
  const Srif opening = mix_.front()(state);
  return {opening.K1, opening.K2, opening.K3};
}

/// The first ring gives the result; its error comes from the other methods, or from the second ring.
std::size_t TipMethods::rings_of(const Integral& integral, bool all) const {
  const std::size_t count = integral.rings.size();
  return all ? count : std::min<std::size_t>(count, integrals_.size() > 1 ? 1 : 2);
}

Srif TipMethods::of(const Integral& integral, std::size_t rings, const Eigen::Vector3d& mix, const NearField& field,
                    const Eigen::VectorXd& forward_work) const {
  Srif result;
  result.position = tip_.position;
  result.method = integral.method;
  result.samples = rings;
  for (std::size_t i = 0; i < rings; ++i) {
    const double G = integral.integrals[i](field, forward_work);
    const auto K = factors(G, mix, section_);
    result.rings.push_back({integral.rings[i].inner, integral.rings[i].outer, G, K[0], K[1], K[2]});
  }
  const RingSrif& first = result.rings.front();
  result.G = first.G, result.K1 = first.K1, result.K2 = first.K2, result.K3 = first.K3;
  return result;
}

/// Twice the largest difference from the other methods by energy, or from the next ring where there is no other, a
/// floor, and what the interaction integral does not agree with the energy release rate, as far as the mode is not
/// the first. The factors are calibrated: theory.md, "What `estimated_error` means".
void TipMethods::estimate(std::vector<Srif>& found, const Eigen::Vector3d& mix) const {
  const double h = section_.thickness;
  const auto distance = [h](const auto& a, const auto& b) {
    return std::max({std::abs(a.K1 - b.K1), std::abs(a.K2 - b.K2), std::abs(a.K3 - b.K3) * h});
  };
  const Eigen::Vector3d energy = unit_release(section_).cwiseProduct(mix.cwiseAbs2());
  const Srif* best = nullptr;
  for (auto& srif : found) {
    if (srif.rings.empty()) continue;
    if (!best) best = &srif;
    const double largest = largest_factor(srif, h);
    if (largest == 0) continue;
    double spread = 0;
    bool compared = false;
    for (const auto& other : found)
      if (!other.rings.empty() && other.method != srif.method) spread = std::max(spread, distance(srif, other)), compared = true;
    if (!compared && srif.rings.size() < 2) continue;  // nothing to compare with
    if (!compared) spread = distance(srif.rings[0], srif.rings[1]);
    const double disagreement = std::abs(1 - std::sqrt(energy.sum() / *srif.G));
    const double other_modes = std::sqrt((energy[1] + energy[2]) / energy.sum());
    srif.estimated_error = 2 * spread / largest + least_error_ + disagreement * other_modes / 2;
  }
  for (auto& srif : found)
    if (best && srif.rings.empty() && largest_factor(srif, h) > 0)
      srif.estimated_error = std::max(srif.estimated_error.value_or(0), 1.5 * distance(srif, *best) / largest_factor(srif, h));
}

std::vector<Srif> TipMethods::operator()(const plate::State& state, const plate::Forces& force, bool all_rings) const {
  const Eigen::Vector3d mix = integrals_.empty() ? Eigen::Vector3d::Zero() : split(state, force);
  const NearField field(state, positions_, surroundings_.centre());
  double radius = 0;
  for (const auto& integral : integrals_)
    for (std::size_t i = 0; i < rings_of(integral, all_rings); ++i) radius = std::max(radius, integral.rings[i].outer);
  const Eigen::VectorXd work = integrals_.empty() ? Eigen::VectorXd() : surroundings_.forward_work(state, force, radius);
  std::vector<Srif> found;
  for (const auto& method : methods_) {
    for (const auto& integral : integrals_)
      if (integral.method == method) found.push_back(of(integral, rings_of(integral, all_rings), mix, field, work));
    for (const auto& opening : openings_)
      if (auto srif = opening(state); srif.method == method) {
        found.push_back(std::move(srif));
        break;
      }
  }
  estimate(found, mix);
  // the faces are loaded in the second and third mode: there the domain integral is better, where the field within a
  // thickness is resolved
  const Eigen::Vector3d energy = unit_release(section_).cwiseProduct(mix.cwiseAbs2());
  const bool sheared = energy[1] + energy[2] > mixed_mode * energy.sum();
  const std::string first = (sheared && !interaction_.empty()) || galerkin_ ? "domain_integral" : "virtual_crack_extension";
  std::stable_partition(found.begin(), found.end(), [&](const Srif& srif) { return srif.method == first; });
  return found;
}

}  // namespace post
