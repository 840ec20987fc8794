#include "fracture/bond_limits.hpp"

#include <cmath>
#include <numbers>

#include "plate/influence.hpp"

namespace fracture {
namespace {

/// Sums over the bonds that cross a unit length of crack, averaged over its directions: weights, and the energies at
/// curvature 1 and shear angle 1.
struct Crossing {
  double weight = 0, curvature = 0, shear = 0;
};

Crossing crossing(const plate::Section& section, const plate::Discretization& d) {
  const double area = d.spacing * d.spacing;
  const auto vectors = plate::full_family(d);
  const auto shapes = plate::bond_shapes(vectors, section, d);
  std::vector<plate::FamilyBond> bonds;
  for (std::size_t i = 0; i < vectors.size(); ++i) bonds.push_back({vectors[i], shapes[i].weight * area});
  const auto full = plate::FamilyRule(section, d)(bonds);
  Crossing result;
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    // |xi| / (pi A) bonds of this vector or its opposite cross a unit of crack, in the mean over directions
    const double length = shapes[i].length, count = length / (std::numbers::pi * area);
    result.weight += count * shapes[i].weight * area * area;
    result.curvature += count * 2 * area * full.bonds[i].B * length * length;
    result.shear += count * 2 * area * full.bonds[i].S * length * length;
  }
  return result;
}

}  // namespace

double apparent_toughness(Growth::Criterion criterion, double thickness_in_spacings, double horizon_ratio) {
  const auto interpolated = [](const auto& table, double x) {
    if (x <= table.front().first) return table.front().second;
    for (std::size_t i = 1; i < table.size(); ++i)
      if (x <= table[i].first)
        return std::lerp(table[i - 1].second, table[i].second, (x - table[i - 1].first) / (table[i].first - table[i - 1].first));
    return table.back().second;
  };
  using Table = std::vector<std::pair<double, double>>;
  const Table energy{{std::log(0.5), 0.93}, {std::log(1.5), 1.02}, {std::log(3), 1.11}, {std::log(6), 1.21}, {std::log(12), 1.28}, {std::log(40), 1.32}};
  const Table curvature = energy;
  const Table horizon{{2.015, 1.2}, {3.015, 1}, {4.015, 0.805}, {5.015, 0.73}};
  const auto& by_thickness = criterion == Growth::Criterion::bond_energy ? energy : curvature;
  return interpolated(by_thickness, std::log(thickness_in_spacings)) * interpolated(horizon, horizon_ratio);
}

BondLimits::BondLimits(const Growth& growth, const plate::Section& section, const plate::Discretization& d)
    : tension_only_(growth.tension_only), by_energy_(growth.criterion == Growth::Criterion::bond_energy) {
  const double R = growth.apparent_toughness.value_or(
      apparent_toughness(growth.criterion, section.thickness / d.spacing, d.horizon_ratio));
  const double toughness = growth.fracture_energy * section.thickness / R;
  const auto all = crossing(section, d);
  curvature_ = std::sqrt(toughness / all.curvature), shear_ = std::sqrt(toughness / all.shear);
  if (by_energy_) {
    energy_ = toughness / all.weight;
    return;
  }
  const bool given = growth.critical_curvature || growth.critical_shear;
  if (growth.fracture_energy == 0 && given) curvature_ = shear_ = INFINITY;
  curvature_ = growth.critical_curvature.value_or(curvature_);
  shear_ = growth.critical_shear.value_or(shear_);
}

double BondLimits::demand(double energy, double curvature_difference, double shear_difference, double length,
                          double weight) const {
  if (tension_only_ && curvature_difference <= 0) return 0;
  if (by_energy_) return energy / (energy_ * weight);
  const double s = curvature_difference / length / curvature_, g = shear_difference / length / shear_;
  return std::max(s * s, g * g);
}

}  // namespace fracture
