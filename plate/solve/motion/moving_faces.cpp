#include "plate/solve/motion/moving_faces.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "plate/formulation/constraints.hpp"
#include "plate/formulation/face_pairs.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/nodal_forces.hpp"

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

/// Shares of free degrees of freedom in the sum of `terms`.
std::map<Dof, AtFaces> folded(const std::vector<MovingPair::Term>& terms, const Constraints& constraints) {
  std::map<Dof, AtFaces> result;
  const auto add = [&](const Dof& dof, double factor, const AtFaces& shares) {
    auto& sum = result[dof];
    for (std::size_t face = 0; face < sum.size(); ++face) sum[face] += factor * shares[face];
  };
  const auto& ties = constraints.ties();
  for (const auto& [dof, shares] : terms) {
    if (!constraints.held(dof)) add(dof, 1, shares);
    for (const auto& tie : std::ranges::equal_range(ties, dof, {}, &Constraints::Tie::follower))
      add(tie.leader, tie.factor, shares);
  }
  return result;
}

/// Groups of these pairs, joined by degrees of freedom that they push.
std::vector<std::vector<std::size_t>> groups_of(const std::vector<std::size_t>& shared,
                                                const std::vector<std::vector<std::size_t>>& pushed) {
  std::vector<std::vector<std::size_t>> result;
  std::map<std::size_t, std::size_t> group_of;  // of what is pushed
  for (const auto pair : shared) {
    std::vector<std::size_t> joined{pair};
    std::set<std::size_t> met;
    for (const auto number : pushed[pair])
      if (const auto found = group_of.find(number); found != group_of.end()) met.insert(found->second);
    for (const auto group : met) {
      joined.insert(joined.end(), result[group].begin(), result[group].end());
      result[group].clear();
    }
    for (const auto one : joined)
      for (const auto number : pushed[one]) group_of[number] = result.size();
    std::ranges::sort(joined);
    result.push_back(std::move(joined));
  }
  std::erase_if(result, [](const auto& group) { return group.empty(); });
  return result;
}

}  // namespace

MovingPair moving_pair(const FacePair& pair, double arm, std::size_t points, const Constraints& constraints,
                       const Forces& mass) {
  MovingPair result;
  const auto plane = std::uint32_t(points);
  for (const auto& [side, sign] : {std::pair(&pair.left, 1.0), std::pair(&pair.right, -1.0)})
    for (const auto& [point, weight] : *side) {
      const double x = sign * weight * pair.normal.x(), y = -sign * weight * pair.normal.y();
      result.terms.push_back({dof(plane + point, 2), {x, x}});
      result.terms.push_back({dof(plane + point, 1), {y, y}});
      result.terms.push_back({dof(point, 2), {arm * x, -arm * x}});
      result.terms.push_back({dof(point, 1), {arm * y, -arm * y}});
    }
  for (const auto& [dof, shares] : folded(result.terms, constraints))
    if (const double m = at_dof(mass, dof); m > 0) result.pushes.push_back({dof, 1 / m, shares});
  return result;
}

MovingFaces::MovingFaces(std::vector<MovingPair> pairs, ContactMemory memory)
    : pairs_(std::move(pairs)), contacts_(pairs_.size()), memory_(std::move(memory)) {
  std::map<Dof, std::vector<std::size_t>> pairs_of;
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    for (const auto& push : pairs_[i].pushes) pairs_of[push.dof].push_back(i);
  std::map<Dof, std::size_t> numbers;
  for (const auto& [dof, of] : pairs_of) {
    numbers[dof] = pushed_.size(), pushed_.push_back(dof);
    if (of.size() > 1) shared_.insert(shared_.end(), of.begin(), of.end());
  }
  std::ranges::sort(shared_);
  shared_.erase(std::unique(shared_.begin(), shared_.end()), shared_.end());
  for (const auto& pair : pairs_) {
    auto& of_pair = number_.emplace_back();
    for (const auto& push : pair.pushes) of_pair.push_back(numbers[push.dof]);
  }
  groups_ = groups_of(shared_, number_);
  change_.resize(pushed_.size());
  memory_.held.resize(2 * pairs_.size()), memory_.closed.resize(2 * pairs_.size());
}

/// Openings of both faces of a pair over a step by unit forces: top by top, top by bottom, bottom by bottom.
std::array<double, 3> MovingFaces::compliance(std::size_t pair) const {
  std::array<double, 3> result{};
  for (const auto& [dof, inverse_mass, shares] : pairs_[pair].pushes) {
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
  for (std::size_t i = 0; i < number_[pair].size(); ++i) {
    const auto& push = pairs_[pair].pushes[i];
    const double change = next ? change_[number_[pair][i]] : -step.time_step * at_dof(step.velocity, push.dof);
    for (std::size_t face = 0; face < result.size(); ++face) result[face] += push.shares[face] * change;
  }
  return result;
}

/// Adds to the forces of a pair.
void MovingFaces::push(std::size_t pair, const AtFaces& force) {
  for (std::size_t i = 0; i < number_[pair].size(); ++i) {
    const auto& [dof, inverse_mass, shares] = pairs_[pair].pushes[i];
    change_[number_[pair][i]] += response_ * inverse_mass * (shares[0] * force[0] + shares[1] * force[1]);
  }
  for (std::size_t face = 0; face < force.size(); ++face) contacts_[pair].force[face] += force[face];
}

/// Finds the force of a pair with those of all others as they are. Returns whether it has changed beyond rounding.
bool MovingFaces::solve(std::size_t pair) {
  constexpr double rounding = 1e-13;
  const auto force = contacts_[pair].force;
  const auto W = compliance(pair);
  AtFaces free = contacts_[pair].opening;
  for (std::size_t i = 0; i < number_[pair].size(); ++i)
    for (std::size_t face = 0; face < free.size(); ++face)
      free[face] += pairs_[pair].pushes[i].shares[face] * change_[number_[pair][i]];
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

void MovingFaces::press(const FreeStep& step, Forces& forces) {
  response_ = step.time_step * step.share / step.drag;
  for (std::size_t i = 0; i < pushed_.size(); ++i)
    change_[i] = step.time_step * (at_dof(step.velocity, pushed_[i]) + step.share * step.acceleration(pushed_[i]));
  size_ = 0;
  for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
    auto& opening = (contacts_[pair] = {}).opening;
    for (const auto& [dof, shares] : pairs_[pair].terms) {
      const double value = at_dof(step.state, dof);
      for (std::size_t face = 0; face < shares.size(); ++face) opening[face] += shares[face] * value;
      size_ = std::max(size_, std::abs(shares[0] * value));
    }
    memory_.so_far.least_opening = std::min({memory_.so_far.least_opening, opening[0], opening[1]});
  }
  for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
    for (std::size_t i = 0; i < number_[pair].size(); ++i)
      size_ = std::max(size_, std::abs(pairs_[pair].pushes[i].shares[0] * change_[number_[pair][i]]));
  }
  for (std::size_t pair = 0; pair < pairs_.size(); ++pair) solve(pair);
  for (const auto& group : groups_) settle(group);
  for (std::size_t pair = 0; pair < pairs_.size(); ++pair)
    if (!std::ranges::binary_search(shared_, pair)) give_back(pair, step);
  for (const auto& group : groups_) give_back_together(group, step);
  add_forces(step, forces);
}

/// Adds the forces to folded ones, and finds what they take of the energy.
void MovingFaces::add_forces(const FreeStep& step, Forces& forces) {
  lost_before_ = lost_after_ = 0;
  for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
    const auto& force = contacts_[pair].force;
    if (force[0] == 0 && force[1] == 0) continue;
    const auto& pushes = pairs_[pair].pushes;
    for (std::size_t i = 0; i < pushes.size(); ++i) {
      const auto& [dof, inverse_mass, shares] = pushes[i];
      const double push = shares[0] * force[0] + shares[1] * force[1];
      at_dof(forces, dof) += push;
      const double change = change_[number_[pair][i]], before = step.time_step * at_dof(step.velocity, dof);
      lost_before_ += step.first ? push * (change - before) / 4 : -push * before / 2;
      lost_after_ -= push * change / 2;
    }
  }
}

}  // namespace plate
