#include "plate/bonds/horizon_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <unordered_map>

#include "plate/bonds/family_weights.hpp"

namespace plate {
namespace {

double linear_share(double length, double horizon, double spacing) {
  return std::clamp((horizon + spacing / 2 - length) / spacing, 0.0, 1.0);
}

bool on_outermost_axis_shell(const Discretization& d, const Eigen::Vector2d& vector) {
  const double shell = std::floor(d.horizon_ratio * (1 + 1e-9)) * d.spacing;
  const double along = vector.cwiseAbs().maxCoeff(), across = vector.cwiseAbs().minCoeff();
  return std::abs(along - shell) < 1e-6 * d.spacing && across < 1e-6 * d.spacing;
}

/// f = 1 - (I4 - 3 I22) / I4 of the outermost axis shell: with it sum w xi^2 c^4 beta = 3 sum w xi^2 c^2 s^2 beta.
double fitted_factor(const Discretization& d) {
  double excess = 0, shell = 0;
  for (const auto& xi : full_family(d)) {
    const double length = xi.norm(), weight = influence(d.influence, length, d.horizon()) / (length * length) *
                                              linear_share(length, d.horizon(), d.spacing);
    const double fourth = weight * std::pow(xi.x(), 4);
    excess += fourth - 3 * weight * std::pow(xi.x() * xi.y(), 2);
    if (on_outermost_axis_shell(d, xi)) shell += fourth;
  }
  return 1 - excess / shell;
}

}  // namespace

double influence(Influence kind, double length, double horizon) {
  return kind == Influence::inverse ? horizon / length : 1;
}

double volume_share(const Discretization& d, const Eigen::Vector2d& vector) {
  if (vector.norm() > d.horizon() * (1 + 1e-9)) return 0;
  if (d.volume_correction == VolumeCorrection::none) return 1;
  const double share = linear_share(vector.norm(), d.horizon(), d.spacing);
  const bool fitted = d.volume_correction == VolumeCorrection::lattice_fitted && on_outermost_axis_shell(d, vector);
  return fitted ? share * fitted_factor(d) : share;
}

std::vector<Eigen::Vector2d> full_family(const Discretization& d) {
  const int reach = static_cast<int>(std::floor(d.horizon_ratio * (1 + 1e-9)));
  std::vector<Eigen::Vector2d> vectors;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x)
      if ((x != 0 || y != 0) && std::hypot(x, y) <= d.horizon_ratio * (1 + 1e-9))
        vectors.emplace_back(x * d.spacing, y * d.spacing);
  return vectors;
}

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
  const double h = section.thickness, bending = section.law == PlateLaw::membrane ? section.young * h / 4
                                                                                  : section.young * std::pow(h, 3) / 48;
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

namespace {

/// The family as a string of bytes: equal where bond vectors and areas are.
std::string key_of(const geometry::Families& families, const std::vector<double>& areas, bool active, std::size_t k) {
  std::string key(1, active ? '1' : '0');
  const auto append = [&key](const auto& value) { key.append(reinterpret_cast<const char*>(&value), sizeof value); };
  append(areas[k]);
  for (const auto& bond : families[k]) {
    append(bond.vector_id);
    append(areas[bond.neighbour]);
  }
  return key;
}

/// True where point k has the family of the point before it.
bool alike(const geometry::Families& families, const std::vector<double>& areas, const std::vector<char>& active,
           std::size_t k) {
  if (families.pattern(k) != families.pattern(k - 1) || areas[k] != areas[k - 1] || active[k] != active[k - 1])
    return false;
  for (const auto& bond : families[k])
    if (areas[bond.neighbour] != areas[bond.neighbour - 1]) return false;
  return true;
}

}  // namespace

FamilyKinds family_kinds(const geometry::Families& families, const std::vector<double>& areas,
                         const std::vector<char>& active) {
  FamilyKinds result;
  result.kind.reserve(families.points());
  std::unordered_map<std::string, std::uint32_t> known;
  for (std::uint32_t k = 0; k < families.points(); ++k) {
    if (k > 0 && alike(families, areas, active, k)) {
      result.kind.push_back(result.kind.back());
      continue;
    }
    const auto [entry, fresh] =
        known.try_emplace(key_of(families, areas, active[k], k), static_cast<std::uint32_t>(known.size()));
    if (fresh) result.example.push_back(k);
    result.kind.push_back(entry->second);
  }
  return result;
}

HorizonWeights weights_of_parameters(const geometry::Families& families, const std::vector<BondShape>& shapes,
                                     const std::vector<double>& areas, const FamilyKinds& kinds,
                                     const std::vector<PointParameters>& parameters) {
  HorizonWeights result{kinds.kind, {}, {0}, {}};
  for (const auto k : kinds.example) {
    const PointParameters& p = parameters[k];
    result.a.push_back(p.a);
    for (const auto& bond : families[k]) {
      const double weighted = shapes[bond.vector_id].weight * areas[bond.neighbour];
      result.bonds.push_back({p.d * weighted, p.b * weighted, p.C / 4 * weighted});
    }
    result.first.push_back(result.bonds.size());
  }
  return result;
}

}  // namespace plate
