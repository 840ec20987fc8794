#include "fracture/breakage/damaged_plate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <span>
#include <tuple>

#include "plate/bonds/results.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/tip_view.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/reduction.hpp"
#include "plate/solve/stretching.hpp"
#include "post/files/frame.hpp"

namespace fracture {
namespace {

// Second moments of families beside clean cracks at 0 to 45 degrees to the lattice: measured 0.6 of a full one's (0.5
// where a crack leaves an edge).
constexpr double gives_way = 0.4;

// Families beside clean cracks at 0 to 45 degrees to the lattice: measured 1.17 of the stiffness of a full family,
// single bonds 2.26.
constexpr double stiffest_family = 1.2, stiffest_bond = 2.4;

/// A full family of a process: its size and cell, what it does in all, and by bond vector [spacings].
struct Full {
  long size = 0, column = 0, row = 0;
  double bending = 0, shear = 0;

  auto rank() const { return std::tuple(-size, row, column); }
};
struct FullBond {
  double x, y, B, S;
};

double second_moment(const std::vector<plate::FamilyBond>& bonds) {
  double sum = 0;
  for (const auto& bond : bonds) sum += bond.weight * bond.vector.squaredNorm();
  return sum;
}

std::size_t longest_family(const geometry::Families& families) {
  std::size_t longest = 0;
  for (std::size_t k = 0; k < families.points(); ++k) longest = std::max(longest, families[k].size());
  return longest;
}

/// The energy that central differences see in a step (theory (58)).
double energy_of_step(const plate::OwnFamily& family, const Motion& motion) {
  const double now = plate::energy(family, motion.state, motion.state);
  return motion.time_step == 0 ? now : now - motion.time_step * plate::energy(family, motion.state, motion.velocity);
}

}  // namespace

double bending_stiffness(double a, std::span<const plate::BondWeights> bonds) {
  double sum = 0, square = 0;
  for (const auto& bond : bonds) sum += bond.B, square += bond.D * bond.D;
  return sum + std::abs(a) * square;
}

double shear_stiffness(std::span<const plate::BondWeights> bonds) {
  double sum = 0;
  for (const auto& bond : bonds) sum += bond.S;
  return sum;
}

Stiffest stiffest(const plate::FamilyOperator& plate, const plate::Boundary& boundary) {
  const auto& families = plate.families();
  const auto& weights = plate.weights();
  const double spacing = boundary.cloud.units.spacing;
  Full full;
  std::vector<FullBond> bonds;
  std::size_t found = 0;
  for (std::size_t k = 0; k < plate.points(); ++k)
    if (boundary.active[k] && boundary.owns(k) && long(families[k].size()) > full.size)
      found = k, full.size = long(families[k].size());
  if (full.size > 0) {
    const std::span own(&weights.of(found, 0), families[found].size());
    const auto [column, row] = geometry::cell_of(boundary.lattice[found]);
    full = {full.size, column, row, bending_stiffness(weights.a[weights.kind[found]], own), shear_stiffness(own)};
    for (std::size_t i = 0; i < own.size(); ++i) {
      const geometry::Point vector = families.vectors()[families[found][i].vector_id] / spacing;
      bonds.push_back({vector.x(), vector.y(), own[i].B, own[i].S});
    }
  }
  const auto every = plate::gathered(boundary.map, std::vector{full});
  const auto first = std::ranges::min_element(every, {}, &Full::rank);
  full = *first;
  bonds = plate::gathered(boundary.map, first - every.begin() == boundary.map.rank() ? bonds : std::vector<FullBond>{});
  Stiffest result{stiffest_family * full.bending, stiffest_family * full.shear, {}};
  for (const auto& vector : families.vectors()) {
    const geometry::Point x = vector / spacing;
    const auto same = std::ranges::find_if(
        bonds, [&](const FullBond& bond) { return std::abs(bond.x - x.x()) + std::abs(bond.y - x.y()) < 0.01; });
    result.bonds.push_back(same == bonds.end()
                               ? plate::BondWeights{INFINITY, INFINITY, INFINITY}
                               : plate::BondWeights{0, stiffest_bond * same->B, stiffest_bond * same->S});
  }
  return result;
}

DamagedPlate::DamagedPlate(const plate::FamilyOperator& base, const plate::Boundary& boundary,
                           const plate::FamilyRule& rule, std::shared_ptr<const plate::Surroundings> seen)
    : base_(base),
      boundary_(boundary),
      rule_(rule),
      families_(base.families()),
      stiffest_(stiffest(base, boundary)),
      broken_(base.points(), longest_family(families_)) {
  if (seen) known_ = seen->known, wider_ = boundary.constraints.fetching(seen->exchange);
  for (const auto& shape : base.shapes()) reach_ = std::max(reach_, shape.length / boundary.cloud.units.spacing);
}

DamagedPlate::DamagedPlate(const plate::Formulation& start, const plate::Formulation* membrane,
                           std::shared_ptr<const plate::Surroundings> seen)
    : DamagedPlate(*start.breaking(), start.boundary(), {start.section(), start.discretization()}, std::move(seen)) {
  if (membrane) plane_ = std::make_unique<DamagedPlate>(*membrane, nullptr, nullptr);
}

/// `left`: share of the family's second moment that is left; `ids`: of its bond vectors.
void DamagedPlate::soften(plate::FamilyWeights& family, double left, const std::vector<std::uint32_t>& ids) const {
  for (std::size_t i = 0; i < ids.size(); ++i) {
    auto& bond = family.bonds[i];
    const auto& most = stiffest_.bonds[ids[i]];
    if (bond.B > most.B) bond.D *= most.B / bond.B, bond.B = most.B;
    bond.S = std::min(bond.S, most.S);
  }
  const double share = std::min(1.0, left / gives_way);
  const double bending = std::min(share, stiffest_.bending / bending_stiffness(family.a, family.bonds));
  const double resists = shear_stiffness(family.bonds);  // nothing in the plane
  const double shear = resists > 0 ? std::min(share, stiffest_.shear / resists) : share;
  if (bending == 1 && shear == 1) return;
  family.a *= bending;
  for (auto& bond : family.bonds) bond.B *= bending, bond.S *= shear;
}

double DamagedPlate::a(std::size_t k) const {
  const auto number = broken_.number(k);
  return number < 0 ? base_.weights().a[base_.weights().kind[k]] : changed_[std::size_t(number)].now.a;
}

const plate::BondWeights& DamagedPlate::weights(std::size_t k, std::size_t i) const {
  const auto number = broken_.number(k);
  return number < 0 ? base_.weights().of(k, i) : changed_[std::size_t(number)].now.bonds[i].weights;
}

Change& DamagedPlate::change(std::uint32_t k) {
  const auto number = std::size_t(broken_.number(k));
  if (number < changed_.size()) return changed_[number];
  const auto& weights = base_.weights();
  Change result{{k, boundary_.cloud.areas[k], weights.a[weights.kind[k]], {}}, {}, 0};
  const auto family = base_.families()[k];
  for (std::size_t i = 0; i < family.size(); ++i) {
    const auto& shape = base_.shapes()[family[i].vector_id];
    const auto& own = weights.of(k, i);
    result.now.bonds.push_back({family[i].neighbour, shape.mx, shape.my, shape.length, own});
    differences_.push_back({family[i].neighbour, shape.mx, shape.my, shape.length, own.D, own.D, 0, 0});
  }
  first_difference_.push_back(differences_.size());
  return changed_.emplace_back(std::move(result));
}

void DamagedPlate::retarget(std::uint32_t k) {
  auto& one = change(k);
  std::vector<plate::FamilyBond> bonds;
  std::vector<std::uint32_t> ids;
  std::vector<geometry::Families::Step> steps;
  const auto family = base_.families()[k];
  const auto& vectors = families_.vectors();
  double whole = 0;
  for (std::size_t i = 0; i < family.size(); ++i) {
    const auto [j, id] = family[i];
    const plate::FamilyBond bond{vectors[id], base_.shapes()[id].weight * boundary_.cloud.areas[j]};
    whole += bond.weight * bond.vector.squaredNorm();
    if (broken_.broken(k, i)) continue;
    bonds.push_back(bond), ids.push_back(id);
    steps.push_back({std::int32_t(std::int64_t(j) - std::int64_t(k)), id});
  }
  families_.set(k, steps);
  auto own = boundary_.active[k] ? rule_(bonds) : plate::FamilyWeights{};
  own.bonds.resize(bonds.size());
  if (!bonds.empty() && boundary_.active[k]) soften(own, second_moment(bonds) / whole, ids);
  one.a_target = own.a;
  one.target.assign(family.size(), {});
  auto next = own.bonds.begin();
  for (std::size_t i = 0; i < family.size(); ++i)
    if (!broken_.broken(k, i)) one.target[i] = *next++;
}

double DamagedPlate::approach(std::uint32_t k, double fraction, const Motion& motion) {
  const auto number = std::size_t(broken_.number(k));
  auto& [now, target, a_target, left, ongoing] = changed_[number];
  const double before = energy_of_step(now, motion);
  const auto mix = [fraction](double from, double to) { return fraction == 1 ? to : from + fraction * (to - from); };
  now.a = mix(now.a, a_target);
  for (std::size_t i = 0; i < now.bonds.size(); ++i) {
    auto& weights = now.bonds[i].weights;
    weights = {mix(weights.D, target[i].D), mix(weights.B, target[i].B), mix(weights.S, target[i].S)};
  }
  differ(number);
  return before - energy_of_step(now, motion);
}

void DamagedPlate::differ(std::size_t number) {
  const auto& now = changed_[number].now;
  for (std::size_t i = 0; i < now.bonds.size(); ++i) {
    const auto& weights = now.bonds[i].weights;
    const auto& first = base_.weights().of(now.point, i);
    auto& difference = differences_[first_difference_[number] + i];
    difference.D_now = weights.D;
    difference.curvature = 2 * now.area * (weights.B - first.B);
    difference.shear = 2 * now.area * (weights.S - first.S);
  }
}

/// `place`: among those of the breakage.
void DamagedPlate::lose(std::uint32_t k, std::size_t i, std::uint64_t place) {
  const auto before = broken_.points();
  broken_.set(k, i);
  if (broken_.points() > before) first_losses_.push_back({events_, place});
}

DamagedPlate::CutBonds DamagedPlate::cut_by(const CrackPiece& piece) const {
  const auto& units = boundary_.cloud.units;
  const auto lattice = geometry::to_lattice({piece.path}, units).front();
  const auto& v = lattice.vertices;
  const geometry::Point end = piece.at_back ? v.back() : v.front(), before = piece.at_back ? v[v.size() - 2] : v[1];
  const geometry::Point begin =
      end + std::min(1.0, piece.length / units.spacing / (before - end).norm()) * (before - end);
  const auto cut = [&](const geometry::Point& p, const geometry::Point& q) {
    return geometry::separates(lattice, p, q);
  };

  CutBonds result;
  // a horizon beside the piece, or beside its image behind an edge that is within one
  const Eigen::AlignedBox2d near(begin.cwiseMin(end).array() - 3 * reach_, begin.cwiseMax(end).array() + 3 * reach_);
  for (std::uint32_t k = 0; k < points(); ++k) {
    if (!near.contains(boundary_.lattice[k]) || !known(k)) continue;
    const auto family = base_.families()[k];
    const auto found = result.bonds.size();
    for (std::size_t i = 0; i < family.size(); ++i) {
      const auto j = family[i].neighbour;
      if (!broken_.broken(k, i) && boundary_.any_image(std::min(k, j), std::max(k, j), cut))
        result.bonds.emplace_back(k, i);
    }
    if (result.bonds.size() > found) result.points.push_back(k);
  }
  return result;
}

/// Pairs of pieces that have points in common, on any rank; a piece and itself where a breakage that goes on has some
/// of its points.
std::vector<std::array<std::size_t, 2>> DamagedPlate::sharing(const std::vector<CutBonds>& cuts) const {
  const auto ongoing = [&](std::uint32_t k) {
    const auto number = broken_.number(k);
    return number >= 0 && changed_[std::size_t(number)].ongoing;
  };
  std::vector<std::array<std::size_t, 2>> result;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    if (std::ranges::any_of(cuts[i].points, ongoing)) result.push_back({i, i});
    for (std::size_t j = 0; j < i; ++j) {
      std::vector<std::uint32_t> both;
      std::ranges::set_intersection(cuts[j].points, cuts[i].points, std::back_inserter(both));
      if (!both.empty()) result.push_back({j, i});
    }
  }
  return plate::gathered(map(), result);
}

/// `cut`: its bonds and points in order, each once.
std::size_t DamagedPlate::begin_breakage(CutBonds cut) {
  OngoingBreakage result{breakages_, std::move(cut.points)};
  ++breakages_, ++events_;
  for (const auto& [k, i] : cut.bonds) lose(k, i, 0), change(k).ongoing = true;
  for (const auto k : result.points) retarget(k);
  going_.push_back(std::move(result));
  return going_.back().number;
}

std::vector<DamagedPlate::CutBonds> DamagedPlate::cuts_by(const std::vector<CrackPiece>& pieces) const {
  std::vector<CutBonds> result;
  for (const auto& piece : pieces) result.push_back(cut_by(piece));
  return result;
}

std::vector<std::optional<std::size_t>> DamagedPlate::break_bonds(const std::vector<CrackPiece>& pieces) {
  const auto cuts = cuts_by(pieces), in_plane = plane_ ? plane_->cuts_by(pieces) : std::vector<CutBonds>{};
  std::vector<std::size_t> first(pieces.size());  // of the pieces that share points with each
  std::iota(first.begin(), first.end(), 0);
  auto shared = sharing(cuts);
  if (plane_) std::ranges::copy(plane_->sharing(in_plane), std::back_inserter(shared));
  for (const auto& [i, j] : shared)
    std::ranges::replace(first, std::max(first[i], first[j]), std::min(first[i], first[j]));
  std::vector<char> waits(pieces.size(), 0);
  for (const auto& [i, j] : shared)
    if (i == j) waits[first[i]] = 1;
  const auto add = [](auto& to, const auto& more) {
    to.insert(to.end(), more.begin(), more.end());
    std::ranges::sort(to);
    to.erase(std::ranges::unique(to).begin(), to.end());
  };
  const auto all_of = [&](const std::vector<CutBonds>& some, std::size_t i) {
    CutBonds all;
    for (std::size_t j = i; j < pieces.size(); ++j)
      if (first[j] == i) add(all.bonds, some[j].bonds), add(all.points, some[j].points);
    return all;
  };
  std::vector<std::optional<std::size_t>> result(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (first[i] != i || waits[i]) continue;
    const auto number = begin_breakage(all_of(cuts, i));
    if (plane_) plane_->begin_breakage(all_of(in_plane, i));
    for (std::size_t j = i; j < pieces.size(); ++j)
      if (first[j] == i) result[j] = number;
  }
  return result;
}

double DamagedPlate::carry_on(std::size_t number, double share, const Motion& motion) {
  const auto found = std::ranges::find(going_, number, &OngoingBreakage::number);
  const double fraction = share >= 1 ? 1 : (share - found->share) / (1 - found->share);
  std::vector<double> spent;
  for (const auto k : found->points) spent.push_back(approach(k, fraction, motion));
  double all = sum_of_all(found->points, spent);
  if (plane_) {
    const plate::State state = plate::of_plane(motion.state), velocity = plate::of_plane(motion.velocity);
    all += plane_->carry_on(number, share, {state, velocity, motion.time_step});
  }
  found->share = share;
  if (share < 1) return all;
  for (const auto k : found->points) changed_[std::size_t(broken_.number(k))].ongoing = false;
  going_.erase(found);
  return all;
}

double DamagedPlate::norm(plate::Forces force, const plate::Forces& diagonal) const {
  boundary_.constraints.fold(force);
  const auto [sum] = plate::ordered_sum<1>(map(), std::size_t(force.size()), [&](std::size_t i) {
    const double f = force.data()[i], d = diagonal.data()[i];
    return std::array<double, 1>{d > 0 ? f * f / d : 0};
  });
  return std::sqrt(sum);
}

double DamagedPlate::sum_of_all(const std::vector<std::uint32_t>& points, const std::vector<double>& values) const {
  return plate::ordered_sum<1>(map(), points.size(), [&](std::size_t i) {
    return std::array<double, 1>{boundary_.owns(points[i]) ? values[i] : 0};
  })[0];
}

void DamagedPlate::break_bonds(const std::vector<PointPair>& bonds, unsigned steps) {
  std::vector<std::uint32_t> touched;
  ++events_;
  for (std::size_t n = 0; n < bonds.size(); ++n)
    for (const std::size_t end : {0, 1}) {
      const auto from = bonds[n][end], to = bonds[n][1 - end];
      if (bonds[n] == outside_overlap || !known(from)) continue;
      lose(from, base_.families()[from].find(to), 2 * n + end);
      auto& one = change(from);
      if (one.left == 0) easing_.push_back(from);
      one.left = steps;
      touched.push_back(from);
    }
  std::ranges::sort(touched);
  touched.erase(std::ranges::unique(touched).begin(), touched.end());
  for (const auto k : touched) retarget(k);
  std::ranges::sort(easing_);  // energies are added in an order that a resumed run finds again
  easing_left_ = std::max(easing_left_, steps);
}

double DamagedPlate::carry_on_all(const Motion& motion) {
  if (easing_left_ == 0) return 0;
  --easing_left_;
  std::vector<double> spent(easing_.size());
#pragma omp parallel for schedule(static) if (easing_.size() > 32)
  for (std::size_t n = 0; n < easing_.size(); ++n) {
    auto& left = changed_[std::size_t(broken_.number(easing_[n]))].left;
    spent[n] = approach(easing_[n], 1.0 / left, motion);
    --left;
  }
  const double sum = sum_of_all(easing_, spent);
  std::erase_if(easing_, [&](std::uint32_t k) { return changed_[std::size_t(broken_.number(k))].left == 0; });
  return sum;
}

void DamagedPlate::internal_force(const plate::State& state, plate::Forces& forces) const {
  base_.internal_force(state, forces);
  const auto kinematics = [&](std::uint32_t k) { return plate::Kinematics<>{state(0, k), state(1, k), state(2, k)}; };
  own_force_.resize(changed_.size()), given_.resize(differences_.size());
#pragma omp parallel for schedule(static) if (changed_.size() > 32)
  for (std::size_t c = 0; c < changed_.size(); ++c) {
    const auto& now = changed_[c].now;
    const auto own = kinematics(now.point);
    double base_sum = 0, sum = 0;
    for (auto i = first_difference_[c]; i < first_difference_[c + 1]; ++i) {
      const double curvature = curvature_difference(differences_[i], own, kinematics(differences_[i].neighbour));
      base_sum += differences_[i].D_base * curvature, sum += differences_[i].D_now * curvature;
    }
    const auto& weights = base_.weights();
    base_sum *= 2 * now.area * weights.a[weights.kind[now.point]], sum *= 2 * now.area * now.a;
    plate::PointValues force(0, 0, 0);
    for (auto i = first_difference_[c]; i < first_difference_[c + 1]; ++i) {
      const auto& d = differences_[i];
      const auto other = kinematics(d.neighbour);
      const double bend = d.D_now * sum - d.D_base * base_sum + d.curvature * curvature_difference(d, own, other);
      const double shear = d.shear * shear_difference(d, own, other), lever = shear * d.length / 2;
      force += plate::PointValues(shear, d.mx * (bend + lever), d.my * (bend + lever));
      given_[i] = {-shear, lever - bend};
    }
    own_force_[c] = force;
  }
  for (std::size_t c = 0; c < changed_.size(); ++c) {
    forces.col(changed_[c].now.point) += own_force_[c];
    for (auto i = first_difference_[c]; i < first_difference_[c + 1]; ++i) {
      const auto& d = differences_[i];
      const auto& [force, couple] = given_[i];
      forces.col(d.neighbour) += plate::PointValues(force, d.mx * couple, d.my * couple);
    }
  }
}

plate::Resultants DamagedPlate::resultants(const plate::State& state) const {
  return plate::resultants(state, families_, base_.shapes(), boundary_.cloud.areas, boundary_.cloud.plate_points,
                           rule_.section());
}

std::shared_ptr<const plate::TipView> DamagedPlate::tip_view() const {
  return std::make_shared<plate::BondView>(boundary_.cloud, families_, base_.shapes(), rule_.section(),
                                           rule_.discretization());
}

plate::Mesh DamagedPlate::draw(post::Frame& frame, const plate::State& state, const plate::Formulation& start,
                               const std::vector<geometry::CrackPath>& cracks) const {
  const auto& first = base_.families();
  const auto& shapes = base_.shapes();
  const auto& cloud = boundary_.cloud;
  frame.resultants = resultants(state);
  frame.damage.assign(cloud.plate_points, 0);
  const auto weight = [&](const geometry::Families& of, std::size_t k) {
    double sum = 0;
    for (const auto& bond : of[k]) sum += shapes[bond.vector_id].weight;
    return sum;
  };
  for (std::size_t k = 0; k < frame.damage.size(); ++k)
    if (families_[k].size() < first[k].size()) frame.damage[k] = 1 - weight(families_, k) / weight(first, k);
  return plate::mesh(boundary_, start.problem().outline, cracks, start.cut(), start.section().thickness);
}

}  // namespace fracture
