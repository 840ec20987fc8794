#include "fracture/bond_check.hpp"

#include <algorithm>
#include <cmath>

namespace fracture {
namespace {

constexpr double suspect = 0.25;  // with 0.15 the same bonds broke in three plates that branch

plate::Kinematics<> kinematics(const plate::State& state, std::uint32_t k) { return {state(0, k), state(1, k), state(2, k)}; }

}  // namespace

BondCheck::BondCheck(const Growth& growth, const BondLimits& limits, const SeveredPlate& plate, const plate::Boundary& boundary)
    : growth_(growth), limits_(limits), plate_(plate), boundary_(boundary), dilatation_(plate.points()),
      marked_(plate.points(), 0) {
  for (std::uint32_t k = 0; k < boundary.cloud.plate_points; ++k) all_.push_back(k);
  const auto& families = plate.base().families();
  for (const auto k : all_) {
    const auto pattern = families.pattern(k);
    if (pattern >= nearest_.size()) nearest_.resize(pattern + 1);
    if (!nearest_[pattern].empty()) continue;
    for (std::uint32_t i = 0; i < families[k].size(); ++i)  // of each two, the one to the point behind
      if (families[k][i].neighbour > k && plate.base().shapes()[families[k][i].vector_id].length < 1.01 * boundary.cloud.units.spacing)
        nearest_[pattern].push_back(i);
  }
}

void BondCheck::find_dilatations(const plate::State& state, const std::vector<std::uint32_t>& points) {
  const auto& families = plate_.base().families();
  const auto& shapes = plate_.base().shapes();
  std::vector<std::uint32_t> wanted;
  const auto want = [&](std::uint32_t k) {
    if (!marked_[k]) marked_[k] = 1, wanted.push_back(k);
  };
  for (const auto k : points) {
    want(k);
    for (const auto bond : families[k]) want(bond.neighbour);
  }
#pragma omp parallel for schedule(static)
  for (std::size_t n = 0; n < wanted.size(); ++n) {
    const auto k = wanted[n];
    const auto own = kinematics(state, k);
    const auto family = families[k];
    double sum = 0;
    for (std::size_t i = 0; i < family.size(); ++i)
      sum += plate_.weights(k, i).D *
             curvature_difference(shapes[family[i].vector_id], own, kinematics(state, family[i].neighbour));
    dilatation_[k] = plate_.a(k) * sum;
  }
  for (const auto k : wanted) marked_[k] = 0;
}

/// visit(j, demand) for the intact bonds k < j, and for those to points that are not marked.
template <typename Visit>
void BondCheck::visit_bonds(std::uint32_t k, const plate::State& state, const Visit& visit) const {
  const auto& base = plate_.base();
  const auto& areas = boundary_.cloud.areas;
  const auto own = kinematics(state, k);
  const auto family = base.families()[k];
  for (std::size_t i = 0; i < family.size(); ++i) {
    const auto [j, id] = family[i];
    if (!boundary_.is_plate(j) || (j < k && marked_[j]) || plate_.broken().broken(k, i)) continue;
    const auto& x = boundary_.cloud.positions;
    if (!growth_.no_fail.empty() && growth_.held((x[k] + x[j]) / 2)) continue;
    const auto& shape = base.shapes()[id];
    const auto other = kinematics(state, j);
    const double curvature = curvature_difference(shape, own, other), shear = shear_difference(shape, own, other);
    const auto& here = plate_.weights(k, i);
    const auto& there = plate_.weights(j, base.families()[j].find(k));
    const double energy = areas[k] * (dilatation_[k] * here.D * curvature + plate::bond_energy(here.B, here.S, curvature, shear)) +
                          areas[j] * (dilatation_[j] * there.D * curvature + plate::bond_energy(there.B, there.S, curvature, shear));
    visit(j, limits_.demand(energy, curvature, shear, shape.length, shape.weight * areas[k] * areas[j]));
  }
}

std::vector<LoadedBond> BondCheck::at_least(double least, const plate::State& state) { return at_least(least, state, all_); }

std::vector<LoadedBond> BondCheck::at_least(double least, const plate::State& state, const std::vector<std::uint32_t>& points) {
  find_dilatations(state, points);
  for (const auto k : points) marked_[k] = 1;
  std::vector<LoadedBond> found;
#pragma omp parallel
  {
    std::vector<LoadedBond> own;
#pragma omp for schedule(static) nowait
    for (std::size_t n = 0; n < points.size(); ++n)
      visit_bonds(points[n], state, [&](std::uint32_t j, double demand) {
        if (demand >= least) own.push_back({{std::min(points[n], j), std::max(points[n], j)}, demand});
      });
#pragma omp critical
    found.insert(found.end(), own.begin(), own.end());
  }
  for (const auto k : points) marked_[k] = 0;
  std::ranges::sort(found, [](const auto& p, const auto& q) { return p.demand != q.demand ? p.demand > q.demand : p.bond < q.bond; });
  return found;
}

double BondCheck::largest(const plate::State& state) {
  find_dilatations(state, all_);
  for (const auto k : all_) marked_[k] = 1;
  double result = 0;
#pragma omp parallel for schedule(static) reduction(max : result)
  for (std::size_t k = 0; k < all_.size(); ++k)
    visit_bonds(std::uint32_t(k), state, [&](std::uint32_t, double demand) { result = std::max(result, demand); });
  for (const auto k : all_) marked_[k] = 0;
  return result;
}

std::vector<std::uint32_t> BondCheck::suspects(const plate::State& state) const {
  const auto& base = plate_.base();
  const double bend = suspect * limits_.curvature() * limits_.curvature(), shear = suspect * limits_.shear() * limits_.shear();
  std::vector<char> hot(all_.size(), 0);
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < hot.size(); ++k) {
    const auto own = kinematics(state, std::uint32_t(k));
    const auto family = base.families()[k];
    const auto look = [&](std::size_t i) {
      const auto [j, id] = family[i];
      if (!boundary_.is_plate(j)) return;
      const auto& shape = base.shapes()[id];
      const auto other = kinematics(state, j);
      // all rotations count: bonds across this one see the curvatures in every direction
      const double x = other.theta_x - own.theta_x, y = other.theta_y - own.theta_y, g = shear_difference(shape, own, other);
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

}  // namespace fracture
