#include "fracture/growth/bond_failure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fracture/growth/distributed_growth.hpp"
#include "plate/bonds/horizon_parameters.hpp"
#include "plate/model/reduction.hpp"

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

namespace {

constexpr double share_of_one = 0.1;
constexpr double suspect = 0.25;  // with 0.15 the same bonds broke in three plates that branch

plate::Kinematics<> kinematics(const plate::State& state, std::uint32_t k) {
  return {state(0, k), state(1, k), state(2, k)};
}

/// Points of the plate, and those of it that they have bonds to.
std::vector<std::uint32_t> with_neighbours(const std::vector<std::uint32_t>& points, const geometry::Families& families,
                                           std::size_t plate_points) {
  std::vector<char> found(plate_points, 0);
  for (const auto k : points) {
    found[k] = 1;
    for (const auto& bond : families[k])
      if (bond.neighbour < plate_points) found[bond.neighbour] = 1;
  }
  std::vector<std::uint32_t> result;
  for (std::uint32_t k = 0; k < plate_points; ++k)
    if (found[k]) result.push_back(k);
  return result;
}

}  // namespace

BondCheck::BondCheck(const Growth& growth, const BondLimits& limits, const DamagedPlate& plate,
                     const plate::Boundary& boundary)
    : growth_(growth),
      limits_(limits),
      plate_(plate),
      boundary_(boundary),
      numbers_(std::make_shared<const PointNumbers>(boundary)),
      dilatation_(plate.points()),
      marked_(plate.points(), 0) {
  const auto& families = plate.base().families();
  const auto plate_points = boundary.cloud.plate_points;
  for (std::uint32_t k = 0; k < plate_points; ++k)
    if (boundary.owns(k)) all_.push_back(k);
  if (boundary.map.distributed()) {
    all_ = with_neighbours(all_, families, plate_points);
    around_ = with_neighbours(all_, families, plate_points);
  }
  for (const auto k : around()) {
    const auto pattern = families.pattern(k);
    if (pattern >= nearest_.size()) nearest_.resize(pattern + 1);
    if (!nearest_[pattern].empty()) continue;
    for (std::uint32_t i = 0; i < families[k].size(); ++i)  // of each two, the one to the point behind
      if (families[k][i].neighbour > k &&
          plate.base().shapes()[families[k][i].vector_id].length < 1.01 * boundary.cloud.units.spacing)
        nearest_[pattern].push_back(i);
  }
}

void BondCheck::find_dilatations(const plate::State& state, const std::vector<std::uint32_t>& points) {
  const auto& shapes = plate_.base().shapes();
#pragma omp parallel for schedule(static)
  for (std::size_t n = 0; n < points.size(); ++n) {
    const auto k = points[n];
    const auto own = kinematics(state, k);
    const auto family = plate_.base().families()[k];
    double sum = 0;
    for (std::size_t i = 0; i < family.size(); ++i)
      sum += plate_.weights(k, i).D *
             curvature_difference(shapes[family[i].vector_id], own, kinematics(state, family[i].neighbour));
    dilatation_[k] = plate_.a(k) * sum;
  }
}

/// True for a bond of the plate that may break.
bool BondCheck::may_break(std::uint32_t k, std::size_t i, std::uint32_t j) const {
  const auto& x = boundary_.cloud.positions;
  return boundary_.is_plate(j) && !plate_.broken().broken(k, i) &&
         (growth_.no_fail.empty() || !growth_.held((x[k] + x[j]) / 2));
}

/// The dilatations of both ends must be known.
double BondCheck::demand(std::uint32_t k, std::size_t i, const plate::State& state) const {
  const auto& base = plate_.base();
  const auto& areas = boundary_.cloud.areas;
  const auto [j, id] = base.families()[k][i];
  const auto& shape = base.shapes()[id];
  const auto own = kinematics(state, k), other = kinematics(state, j);
  const double curvature = curvature_difference(shape, own, other), shear = shear_difference(shape, own, other);
  const auto& here = plate_.weights(k, i);
  const auto& there = plate_.weights(j, base.families()[j].find(k));
  const double energy =
      areas[k] * (dilatation_[k] * here.D * curvature + plate::bond_energy(here.B, here.S, curvature, shear)) +
      areas[j] * (dilatation_[j] * there.D * curvature + plate::bond_energy(there.B, there.S, curvature, shear));
  return limits_.demand(energy, curvature, shear, shape.length, shape.weight * areas[k] * areas[j]);
}

std::vector<LoadedBond> BondCheck::at_least(double least, const plate::State& state,
                                            const std::vector<std::uint32_t>& points) {
  // first by curvature and shear alone: the longest bond, the dilatation and weights beside damage make a factor of 7
  // at most
  const double bend = least * share_of_one * limits_.curvature() * limits_.curvature();
  const double twist = least * share_of_one * limits_.shear() * limits_.shear();
  const auto& base = plate_.base();
  for (const auto k : points) marked_[k] = 1;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> bonds;  // point, number in its family
#pragma omp parallel
  {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
#pragma omp for schedule(static) nowait
    for (std::size_t n = 0; n < points.size(); ++n) {
      const auto k = points[n];
      const auto own = kinematics(state, k);
      const auto family = base.families()[k];
      for (std::uint32_t i = 0; i < family.size(); ++i) {
        const auto [j, id] = family[i];
        if ((j < k && marked_[j]) || !boundary_.owns(std::min(k, j))) continue;
        const auto& shape = base.shapes()[id];
        const auto other = kinematics(state, j);
        const double s = curvature_difference(shape, own, other), g = shear_difference(shape, own, other);
        const double square = shape.length * shape.length;
        if ((s * s >= bend * square || g * g >= twist * square) && may_break(k, i, j)) found.emplace_back(k, i);
      }
    }
#pragma omp critical
    bonds.insert(bonds.end(), found.begin(), found.end());
  }
  for (const auto k : points) marked_[k] = 0;

  std::vector<std::uint32_t> ends;
  for (const auto& [k, i] : bonds)
    for (const auto end : {k, base.families()[k][i].neighbour})
      if (!marked_[end]) marked_[end] = 1, ends.push_back(end);
  for (const auto k : ends) marked_[k] = 0;
  find_dilatations(state, ends);
  std::vector<LoadedBond> result;
  for (const auto& [k, i] : bonds) {
    const auto j = base.families()[k][i].neighbour;
    if (const double now = demand(k, i, state); now >= least)
      result.push_back({{numbers_->of(std::min(k, j)), numbers_->of(std::max(k, j))}, now});
  }
  result = plate::gathered(plate_.map(), result);
  std::ranges::sort(result, [](const auto& p, const auto& q) {
    return p.demand != q.demand ? p.demand > q.demand : p.bond < q.bond;
  });
  return result;
}

double BondCheck::largest(const plate::State& state) {
  find_dilatations(state, all_);
  double result = 0;
#pragma omp parallel for schedule(static) reduction(max : result)
  for (std::size_t n = 0; n < all_.size(); ++n) {
    const auto k = all_[n];
    if (!boundary_.owns(k)) continue;
    const auto family = plate_.base().families()[k];
    for (std::size_t i = 0; i < family.size(); ++i)
      if (const auto j = family[i].neighbour; j > k && may_break(k, i, j))
        result = std::max(result, demand(k, i, state));
  }
  return plate::largest_of(plate_.map(), result);
}

std::vector<std::uint32_t> BondCheck::suspects(const plate::State& state) const {
  const auto& base = plate_.base();
  const double bend = suspect * limits_.curvature() * limits_.curvature(),
               shear = suspect * limits_.shear() * limits_.shear();
  std::vector<char> hot(boundary_.cloud.plate_points, 0);
#pragma omp parallel for schedule(static)
  for (std::size_t n = 0; n < around().size(); ++n) {
    const auto k = around()[n];
    const auto own = kinematics(state, k);
    const auto family = base.families()[k];
    const auto look = [&](std::size_t i) {
      const auto [j, id] = family[i];
      if (!boundary_.is_plate(j)) return;
      const auto& shape = base.shapes()[id];
      const auto other = kinematics(state, j);
      // all rotations count: bonds across this one see the curvatures in every direction
      const double x = other.theta_x - own.theta_x, y = other.theta_y - own.theta_y,
                   g = shear_difference(shape, own, other);
      const double square = shape.length * shape.length;
      if (x * x + y * y >= bend * square || g * g >= shear * square) hot[k] = 1;
    };
    if (plate_.broken().number(k) < 0) {
      for (const auto i : nearest_[base.families().pattern(k)]) look(i);
      continue;
    }
    for (std::size_t i = 0; i < family.size(); ++i)  // bonds may bridge what has parted
      if (!plate_.broken().broken(k, i)) look(i);
  }
  std::vector<char> near(plate_.points(), 0);
  for (std::uint32_t k = 0; k < hot.size(); ++k) {
    if (!hot[k]) continue;
    near[k] = 1;
    for (const auto bond : base.families()[k]) near[bond.neighbour] = 1;
  }
  std::vector<std::uint32_t> result;
  for (const auto k : all_)
    if (near[k]) result.push_back(k);
  return result;
}

std::vector<std::uint32_t> BondCheck::numbers(const std::vector<std::uint32_t>& suspects) const {
  std::vector<std::uint32_t> result;
  for (const auto k : suspects)
    if (boundary_.owns(k)) result.push_back(numbers_->of(k));
  result = plate::gathered(plate_.map(), result);
  std::ranges::sort(result);
  return result;
}

std::vector<std::uint32_t> BondCheck::points(const std::vector<std::uint32_t>& numbers) const {
  std::vector<std::uint32_t> result;
  for (const auto k : all_)
    if (std::ranges::binary_search(numbers, numbers_->of(k))) result.push_back(k);
  return result;
}

std::vector<PointPair> BondCheck::here(const std::vector<LoadedBond>& bonds) const {
  std::vector<PointPair> result;
  for (const auto& [bond, demand] : bonds) {
    const auto k = numbers_->point(bond[0]), j = numbers_->point(bond[1]);
    result.push_back(k && j ? PointPair{*k, *j} : outside_overlap);
  }
  return result;
}

}  // namespace fracture
