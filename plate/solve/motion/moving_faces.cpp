#include "plate/solve/motion/moving_faces.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <set>
#include <stdexcept>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/face_pairs.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/reduction.hpp"
#include "plate/solve/crack_contact.hpp"

namespace plate {
namespace {

/// Forces f >= 0 of W f + g >= 0 with f (W f + g) = 0, of a positive W [2 x 2].
AtFaces complementary(const std::array<double, 3>& W, const AtFaces& g) {
  constexpr double singular = 1e-9, more = 1e-8;
  const auto& [first, beside, second] = W;
  if (g[0] >= 0 && g[1] >= 0) return {0, 0};
  if (first > 0 && g[0] < 0 && g[1] - beside / first * g[0] >= 0) return {-g[0] / first, 0};
  if (second > 0 && g[1] < 0 && g[0] - beside / second * g[1] >= 0) return {0, -g[1] / second};
  // faces that cannot turn, or cannot move, share a force evenly
  const bool even = first * second - beside * beside <= singular * first * second;
  const double a = even ? first * (1 + more) : first, b = even ? second * (1 + more) : second,
               determinant = a * b - beside * beside;
  if (!(determinant > 0)) return {0, 0};  // supports hold both
  return {std::max(0.0, (beside * g[1] - b * g[0]) / determinant),
          std::max(0.0, (beside * g[0] - a * g[1]) / determinant)};
}

using Shares = std::map<Dof, AtFaces>;  // in the openings of a pair

void add(Shares& sum, const Dof& dof, double factor, const AtFaces& shares) {
  auto& at = sum[dof];
  for (std::size_t face = 0; face < at.size(); ++face) at[face] += factor * shares[face];
}

/// Shares of the points of a rank.
Shares shares_of(const FacePair& pair, double arm, std::size_t points) {
  Shares result;
  const auto plane = std::uint32_t(points);
  for (const auto& [side, sign] : {std::pair(&pair.left, 1.0), std::pair(&pair.right, -1.0)})
    for (const auto& [point, weight] : *side) {
      const double x = sign * weight * pair.normal.x(), y = -sign * weight * pair.normal.y();
      add(result, dof(plane + point, 2), 1, {x, x});
      add(result, dof(plane + point, 1), 1, {y, y});
      add(result, dof(point, 2), arm, {x, -x});
      add(result, dof(point, 1), arm, {y, -y});
    }
  return result;
}

/// Shares of free degrees of freedom in the same openings.
Shares folded(const Shares& shares, const Constraints& constraints) {
  Shares result;
  const auto& ties = constraints.ties();
  for (const auto& [dof, of_dof] : shares) {
    if (!constraints.held(dof)) add(result, dof, 1, of_dof);
    for (const auto& tie : std::ranges::equal_range(ties, dof, {}, &Constraints::Tie::follower))
      add(result, tie.leader, tie.factor, of_dof);
  }
  return result;
}

/// Degree of freedom in an order that all numbers of ranks share: point, or row and column of its cell; component, in
/// the plane three more.
using Key = std::array<std::int64_t, 3>;

/// Share of a degree of freedom in the openings of a pair, as ranks tell each other.
struct ToldShare {
  std::int64_t pair, pushes;  // pushes: 1 of what is free, else 0
  Key key;
  AtFaces shares;
  double inverse_mass;  // of what is free
};

/// Keys of the degrees of freedom of a plate and its plane.
class Keys {
public:
  explicit Keys(const Formulation& plate) : points_(plate.points()), boundary_(plate.boundary()) {}
  bool owns(const Dof& dof) const { return boundary_.owns(dof.point % points_); }
  Key operator()(const Dof& dof) const {
    const auto k = dof.point % points_;
    const auto component = std::int64_t(dof.component) + (dof.point < points_ ? 0 : unknowns_per_point);
    const auto& [map, lattice] = std::tie(boundary_.map, boundary_.lattice);
    if (!map.distributed()) return {std::int64_t(k), 0, component};
    if (!map.global.empty()) return {map.global[k], 0, component};
    const auto [column, row] = geometry::cell_of(lattice[k]);
    return {row, column, component};
  }

private:
  std::size_t points_;
  const Boundary& boundary_;
};

/// Groups of these pairs, joined by degrees of freedom that they push.
std::vector<std::vector<std::size_t>> groups_of(const std::vector<std::size_t>& shared,
                                                const std::vector<MovingPair>& pairs) {
  std::vector<std::vector<std::size_t>> result;
  std::map<std::uint32_t, std::size_t> group_of;  // of what is pushed
  for (const auto pair : shared) {
    std::vector<std::size_t> joined{pair};
    std::set<std::size_t> met;
    for (const auto& push : pairs[pair].pushes)
      if (const auto found = group_of.find(push.number); found != group_of.end()) met.insert(found->second);
    for (const auto group : met) {
      joined.insert(joined.end(), result[group].begin(), result[group].end());
      result[group].clear();
    }
    for (const auto one : joined)
      for (const auto& push : pairs[one].pushes) group_of[push.number] = result.size();
    std::ranges::sort(joined);
    result.push_back(std::move(joined));
  }
  std::erase_if(result, [](const auto& group) { return group.empty(); });
  return result;
}

}  // namespace

MovingPairs moving_pairs(const FaceRows& rows, const Formulation& plate, const Constraints& constraints,
                         const Forces& mass) {
  const Keys key_of(plate);
  std::map<Key, Dof> here;
  std::vector<ToldShare> told;
  const auto tell = [&](std::size_t pair, bool pushes, const Dof& dof, const AtFaces& shares, double inverse_mass) {
    if (!key_of.owns(dof)) throw std::logic_error("a point on a crack follows one of another rank");
    const auto key = key_of(dof);
    here.emplace(key, dof), told.push_back({std::int64_t(pair), pushes, key, shares, inverse_mass});
  };
  for (std::size_t i = 0; i < rows.pairs().size(); ++i) {
    const auto shares = shares_of(rows.pairs()[i], rows.arms()[Eigen::Index(i)], plate.points());
    for (const auto& [dof, of_dof] : shares) tell(i, false, dof, of_dof, 0);
    for (const auto& [dof, of_dof] : folded(shares, constraints))
      if (const double m = at_dof(mass, dof); m > 0) tell(i, true, dof, of_dof, 1 / m);
  }
  if (plate.distributed()) told = gathered(plate, told);
  std::ranges::sort(told, {}, [](const ToldShare& one) { return std::tie(one.pair, one.pushes, one.key); });

  std::map<Key, std::uint32_t> numbers;
  for (const auto& one : told) numbers.emplace(one.key, 0);
  MovingPairs result{std::vector<MovingPair>(rows.pairs().size()), {}, &plate.communicator()};
  for (auto& [key, number] : numbers) {
    number = std::uint32_t(result.dofs.size());
    const auto found = here.find(key);
    result.dofs.push_back(found == here.end() ? std::nullopt : std::optional(found->second));
  }
  for (const auto& [pair, pushes, key, shares, inverse_mass] : told) {
    auto& of_pair = result.pairs[std::size_t(pair)];
    if (pushes)
      of_pair.pushes.push_back({numbers[key], inverse_mass, shares});
    else
      of_pair.terms.push_back({numbers[key], shares});
  }
  return result;
}

MovingFaces::MovingFaces(MovingPairs faces, ContactMemory memory)
    : faces_(std::move(faces)), contacts_(faces_.pairs.size()), memory_(std::move(memory)) {
  std::map<std::uint32_t, std::vector<std::size_t>> pairs_of;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    for (const auto& push : faces_.pairs[i].pushes) pairs_of[push.number].push_back(i);
  for (const auto& [number, of] : pairs_of) {
    pushed_.push_back(number);
    if (of.size() > 1) shared_.insert(shared_.end(), of.begin(), of.end());
  }
  std::ranges::sort(shared_);
  shared_.erase(std::unique(shared_.begin(), shared_.end()), shared_.end());
  groups_ = groups_of(shared_, faces_.pairs);
  memory_.held.resize(2 * contacts_.size()), memory_.closed.resize(2 * contacts_.size());
}

/// Takes what moves at a step from the ranks that own it: each number is theirs, all others add nothing to its bits.
void MovingFaces::read(const FreeStep& step) {
  const auto count = faces_.dofs.size();
  for (auto* values : {&displacement_, &velocity_, &change_}) values->assign(count, 0);
  for (std::size_t n = 0; n < count; ++n)
    if (const auto& dof = faces_.dofs[n]) displacement_[n] = at_dof(step.state, *dof);
  for (const auto n : pushed_)
    if (const auto& dof = faces_.dofs[n]) {
      velocity_[n] = at_dof(step.velocity, *dof);
      change_[n] = step.time_step * (velocity_[n] + step.share * step.acceleration(*dof));
    }
  if (!faces_.communicator->distributed()) return;
  std::vector<std::int64_t> bits;
  for (const auto* values : {&displacement_, &velocity_, &change_})
    for (const double value : *values) bits.push_back(std::bit_cast<std::int64_t>(value));
  faces_.communicator->sum(bits);
  auto next = bits.begin();
  for (auto* values : {&displacement_, &velocity_, &change_})
    for (double& value : *values) value = std::bit_cast<double>(*next++);
}

/// Openings of both faces of a pair over a step by unit forces: top by top, top by bottom, bottom by bottom.
std::array<double, 3> MovingFaces::compliance(std::size_t pair) const {
  std::array<double, 3> result{};
  for (const auto& [number, inverse_mass, shares] : faces_.pairs[pair].pushes) {
    const double mobility = response_ * inverse_mass;
    result[0] += mobility * shares[0] * shares[0];
    result[1] += mobility * shares[0] * shares[1];
    result[2] += mobility * shares[1] * shares[1];
  }
  return result;
}

/// Openings of a pair at the next step, or at the one before.
AtFaces MovingFaces::opening(std::size_t pair, const FreeStep& step, bool next) const {
  auto result = contacts_[pair].opening;
  for (const auto& [number, inverse_mass, shares] : faces_.pairs[pair].pushes) {
    const double change = next ? change_[number] : -step.time_step * velocity_[number];
    for (std::size_t face = 0; face < result.size(); ++face) result[face] += shares[face] * change;
  }
  return result;
}

/// Adds to the forces of a pair.
void MovingFaces::push(std::size_t pair, const AtFaces& force) {
  for (const auto& [number, inverse_mass, shares] : faces_.pairs[pair].pushes)
    change_[number] += response_ * inverse_mass * (shares[0] * force[0] + shares[1] * force[1]);
  for (std::size_t face = 0; face < force.size(); ++face) contacts_[pair].force[face] += force[face];
}

/// Finds the force of a pair with those of all others as they are. Returns whether it has changed beyond rounding.
bool MovingFaces::solve(std::size_t pair) {
  constexpr double rounding = 1e-13;
  const auto force = contacts_[pair].force;
  const auto W = compliance(pair);
  AtFaces free = contacts_[pair].opening;
  for (const auto& [number, inverse_mass, shares] : faces_.pairs[pair].pushes)
    for (std::size_t face = 0; face < free.size(); ++face) free[face] += shares[face] * change_[number];
  free[0] -= W[0] * force[0] + W[1] * force[1], free[1] -= W[1] * force[0] + W[2] * force[1];
  for (double& one : free)
    if (one > -rounding * size_) one = std::max(one, 0.0);
  const auto found = complementary(W, free);
  const AtFaces more{found[0] - force[0], found[1] - force[1]};
  if (more[0] == 0 && more[1] == 0) return false;
  push(pair, more);
  contacts_[pair].force = found;
  return std::max(W[0] * std::abs(more[0]), W[2] * std::abs(more[1])) > rounding * size_;
}

/// Counts what a pair of its own loses in the step, and gives it what it holds where it opens: by the force f along d
/// whose work is that energy, f d (g^(n+1) - g^(n-1)) / 2, with what is still pressed kept closed.
void MovingFaces::give_back(std::size_t pair, const FreeStep& step) {
  double* const held = memory_.held.data() + 2 * pair;
  char* const closed = memory_.closed.data() + 2 * pair;
  const auto force = contacts_[pair].force;
  const auto before = opening(pair, step, false), next = opening(pair, step, true);
  AtFaces along{0, 0};
  double energy = 0, way = 0;
  for (const std::size_t face : {0, 1}) {
    if (force[face] > 0)
      held[face] += force[face] * (before[face] - next[face]) / (step.first ? 4 : 2);
    else if (closed[face] && held[face] > 0)
      along[face] = 1, energy += held[face], way += next[face] - before[face];
    closed[face] = force[face] > 0;
  }
  if (!(energy > 0)) return;
  const auto W = compliance(pair);
  const std::size_t other = along[0] > 0 ? 1 : 0;
  const double of_other = W[2 * other];
  double compliance = along[0] * W[0] + along[1] * W[2] + 2 * along[0] * along[1] * W[1];
  const bool pressed = force[other] > 0;
  if (pressed) compliance -= W[1] * W[1] / of_other;
  constexpr double none = 1e-9;  // supports hold both faces together
  if (compliance <= none * (W[0] + W[2])) return;
  const double f = (std::sqrt(way * way + 8 * compliance * energy) - way) / (2 * compliance);
  AtFaces more{along[0] * f, along[1] * f};
  if (pressed) more[other] = -W[1] / of_other * f;
  if (force[other] + more[other] < 0) return;
  push(pair, more);
  for (const std::size_t face : {0, 1})
    if (along[face] > 0) held[face] = 0;
  if (const double after = opening(pair, step, true)[other]; along[other] == 0 && !pressed && after < 0) {
    more = {0, 0}, more[other] = -after / of_other;
    push(pair, more);
  }
}

/// Solves all pairs of a group in turn until nothing changes.
void MovingFaces::settle(const std::vector<std::size_t>& group) {
  constexpr std::size_t most = 10000;
  std::size_t sweeps = 0;
  for (bool changes = true; changes; ++sweeps) {
    if (sweeps == most)
      throw NumericalError(
          "contact of crack faces: forces where cracks meet do not settle: take a finer spacing, or remove `contact`");
    changes = false;
    for (const auto pair : group) changes = solve(pair) || changes;
  }
}

/// Gives a group what those of its faces hold that open, as give_back() does: by forces in the ratio of those by which
/// each alone would give its own. The others of the group are solved beside these forces.
void MovingFaces::give_back_together(const std::vector<std::size_t>& group, const FreeStep& step) {
  std::vector<AtFaces> along(group.size(), AtFaces{});
  double energy = 0;
  for (std::size_t i = 0; i < group.size(); ++i) {
    const auto W = compliance(group[i]);
    for (const std::size_t face : {0, 1}) {
      const std::size_t row = 2 * group[i] + face;
      const double held = memory_.held[row];
      if (contacts_[group[i]].force[face] > 0 || !memory_.closed[row] || !(held > 0) || !(W[2 * face] > 0)) continue;
      along[i][face] = std::sqrt(held / W[2 * face]), energy += held;
    }
  }
  const auto given = energy > 0 ? give(group, along, energy, step) : Given{};
  for (std::size_t i = 0; i < group.size(); ++i) {
    const auto before = opening(group[i], step, false), next = opening(group[i], step, true);
    auto& force = contacts_[group[i]].force;
    for (const std::size_t face : {0, 1}) {
      double& held = memory_.held[2 * group[i] + face];
      memory_.closed[2 * group[i] + face] = force[face] > 0;
      if (force[face] > 0) held += force[face] * (before[face] - next[face]) / (step.first ? 4 : 2);
      if (given.force > 0 && along[i][face] > 0)
        held *= 1 - given.work / energy, force[face] += given.force * along[i][face];
    }
  }
}

/// Finds the force along these by which a group takes an energy over the step, and the work that it does; none where
/// supports hold its faces together.
MovingFaces::Given MovingFaces::give(const std::vector<std::size_t>& group, const std::vector<AtFaces>& along,
                                     double energy, const FreeStep& step) {
  constexpr int trials = 4;  // what touches beside these forces changes with them
  constexpr double none = 1e-9;
  const auto way = [&](bool next) {
    double result = 0;
    for (std::size_t i = 0; i < group.size(); ++i) {
      if (along[i] == AtFaces{}) continue;
      const auto at = opening(group[i], step, next);
      result += along[i][0] * at[0] + along[i][1] * at[1];
    }
    return result;
  };
  const double free = way(true), d = free - way(false);
  press_along(group, along, 1);
  double compliance = way(true) - free;
  press_along(group, along, -1);
  double force = 0;
  for (int trial = 0; trial < trials; ++trial) {
    if (!(compliance > none * energy)) {  // the sum of what the faces alone would have, as they are weighed
      press_along(group, along, -force), settle(group);
      return {};
    }
    const double next = (std::sqrt(d * d + 8 * compliance * energy) - d) / (2 * compliance);
    press_along(group, along, next - force), force = next;
    settle(group);
    compliance = (way(true) - free) / force;
  }
  return {force, force * (d + compliance * force) / 2};
}

/// Adds forces along these to what moves, not to those of contact.
void MovingFaces::press_along(const std::vector<std::size_t>& group, const std::vector<AtFaces>& along, double force) {
  for (std::size_t i = 0; i < group.size(); ++i) {
    if (along[i] == AtFaces{}) continue;
    const auto contact = contacts_[group[i]].force;
    push(group[i], {force * along[i][0], force * along[i][1]});
    contacts_[group[i]].force = contact;
  }
}

/// Finds the openings of the step, and the size of displacements of faces.
void MovingFaces::find_openings() {
  size_ = 0;
  for (std::size_t pair = 0; pair < contacts_.size(); ++pair) {
    auto& opening = (contacts_[pair] = {}).opening;
    for (const auto& [number, shares] : faces_.pairs[pair].terms) {
      const double value = displacement_[number];
      for (std::size_t face = 0; face < shares.size(); ++face) opening[face] += shares[face] * value;
      size_ = std::max(size_, std::abs(shares[0] * value));
    }
    for (const auto& [number, inverse_mass, shares] : faces_.pairs[pair].pushes)
      size_ = std::max(size_, std::abs(shares[0] * change_[number]));
    memory_.so_far.least_opening = std::min({memory_.so_far.least_opening, opening[0], opening[1]});
  }
}

void MovingFaces::press(const FreeStep& step, Forces& forces) {
  response_ = step.time_step * step.share / step.drag;
  read(step), find_openings();
  for (std::size_t pair = 0; pair < contacts_.size(); ++pair) solve(pair);
  for (const auto& group : groups_) settle(group);
  for (std::size_t pair = 0; pair < contacts_.size(); ++pair)
    if (!std::ranges::binary_search(shared_, pair)) give_back(pair, step);
  for (const auto& group : groups_) give_back_together(group, step);
  add_forces(step, forces);
}

/// Adds the forces to folded ones, and finds what they take of the energy.
void MovingFaces::add_forces(const FreeStep& step, Forces& forces) {
  lost_before_ = lost_after_ = 0;
  for (std::size_t pair = 0; pair < contacts_.size(); ++pair) {
    const auto& force = contacts_[pair].force;
    if (force[0] == 0 && force[1] == 0) continue;
    for (const auto& [number, inverse_mass, shares] : faces_.pairs[pair].pushes) {
      const double push = shares[0] * force[0] + shares[1] * force[1];
      if (const auto& dof = faces_.dofs[number]) at_dof(forces, *dof) += push;
      const double before = step.time_step * velocity_[number];
      lost_before_ += step.first ? push * (change_[number] - before) / 4 : -push * before / 2;
      lost_after_ -= push * change_[number] / 2;
    }
  }
}

}  // namespace plate
