#include "plate/bonds/parameters/horizon_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include "plate/bonds/parameters/family_rule.hpp"
#include "plate/bonds/parameters/influence.hpp"

namespace plate {
void add(FamilySums& sums, const BondShape& bond, double share, double thickness, double area) {
  const double weighted = bond.weight * area;  // omega V
  const double square = bond.length * bond.length;
  sums.volume += thickness * share * area;
  sums.first += weighted * bond.length;
  sums.second += weighted * square;
  sums.twist += weighted * square * bond.mx * bond.mx * bond.my * bond.my;
}

PointParameters disc_parameters(const Section& section, Influence kind, double horizon) {
  // integrals over the disc of omega xi, omega xi^2 with omega = horizon/xi or 1
  const double pi = std::numbers::pi, h = section.thickness;
  const bool inverse = kind == Influence::inverse;
  const double first = inverse ? pi * std::pow(horizon, 3) : 2 * pi * std::pow(horizon, 3) / 3;
  const double second = inverse ? 2 * pi * std::pow(horizon, 4) / 3 : pi * std::pow(horizon, 4) / 2;
  return arbitrary_horizon(section, TwistMatch::frame_invariant, {0, h * first, h * second, h * second / 8},
                           h * second / 8);
}

PointParameters arbitrary_horizon(const Section& section, TwistMatch match, const FamilySums& sums, double full_twist) {
  if (sums.second <= 0) return {};
  const double bending = section.young * std::pow(section.thickness, 3) / 48;
  const double twist = match == TwistMatch::frame_invariant ? sums.second / 8 : std::max(sums.twist, full_twist / 8);
  PointParameters p;
  p.d = 2 / sums.first;                                           // Dai 29
  p.b = bending / (1 + section.poisson) / twist;                  // Dai 35
  p.a = bending / (1 - section.poisson) - p.b / 4 * sums.second;  // Dai 32
  p.C = 4 * section.shear_stiffness() / sums.second;              // Dai 38
  return p;
}

std::vector<BondShape> bond_shapes(const std::vector<geometry::Point>& vectors, const Section& section,
                                   const Discretization& d) {
  std::vector<BondShape> shapes;
  shapes.reserve(vectors.size());
  for (const auto& xi : vectors) {
    const double length = xi.norm();
    const double weight = influence(d.influence, length, d.horizon()) * volume_share(d, xi) * section.thickness;
    shapes.push_back({xi.y() / length, -xi.x() / length, length, weight});
  }
  return shapes;
}

std::vector<PointParameters> horizon_parameters(const geometry::Families& families,
                                                const std::vector<BondShape>& shapes, const std::vector<double>& areas,
                                                const std::vector<char>& active, const Section& section,
                                                const Discretization& d) {
  const ParameterRule rule(section, d);
  std::vector<double> shares;
  for (const auto& xi : families.vectors()) shares.push_back(volume_share(d, xi));

  std::vector<PointParameters> result(families.points());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < families.points(); ++k) {
    if (!active[k] || families[k].empty()) continue;
    FamilySums sums;
    for (const auto [j, id] : families[k]) add(sums, shapes[id], shares[id], section.thickness, areas[j]);
    result[k] = rule(sums);
  }
  return result;
}

}  // namespace plate
