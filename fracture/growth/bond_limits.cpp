#include "fracture/growth/bond_limits.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plate/bonds/parameters/influence.hpp"

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

/// Linear in the logarithm of x, constant beyond the ends of the table.
double interpolated(const std::vector<std::pair<double, double>>& table, double x) {
  const auto above = std::ranges::find_if(table, [x](const auto& row) { return row.first >= x; });
  if (above == table.begin()) return above->second;
  if (above == table.end()) return table.back().second;
  const auto& [x0, y0] = *std::prev(above);
  return std::lerp(y0, above->second, std::log(x / x0) / std::log(above->first / x0));
}

}  // namespace

double apparent_toughness(Growth::Criterion criterion, double thickness, const plate::Discretization& d) {
  using Table = std::vector<std::pair<double, double>>;
  static const Table energy{{0.5, 0.93}, {1.5, 1.02}, {3, 1.11}, {6, 1.21}, {12, 1.28}, {40, 1.35}};
  static const Table curvature{{1.5, 1.38}, {3, 1.41}, {6, 1.43}, {12, 1.49}};
  static const Table horizon{{2.015, 1.5}, {3.015, 1}, {4.015, 0.81}, {5.015, 0.7}};
  const double weights = d.surface_correction == plate::SurfaceCorrection::none     ? 1.4
                         : d.surface_correction == plate::SurfaceCorrection::volume ? 1.23
                                                                                    : 1;
  return interpolated(criterion == Growth::Criterion::bond_energy ? energy : curvature, thickness / d.spacing) *
         interpolated(horizon, d.horizon_ratio) * weights;
}

BondLimits::BondLimits(const Growth& growth, const plate::Section& section, const plate::Discretization& d)
    : tension_only_(growth.tension_only), by_energy_(growth.criterion == Growth::Criterion::bond_energy) {
  const double R = growth.apparent_toughness.value_or(apparent_toughness(growth.criterion, section.thickness, d));
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
  if (tension_only_ && curvature_difference >= 0)
    return 0;  // u = -z psi: opens on the z > 0 face where psi decreases along it
  if (by_energy_) return energy / (energy_ * weight);
  const double s = curvature_difference / length / curvature_, g = shear_difference / length / shear_;
  return std::max(s * s, g * g);
}

}  // namespace fracture
