#include "fracture/growth/motion/breaking_bonds.hpp"

#include <unordered_map>

namespace fracture {
namespace {

constexpr std::size_t search_every = 4;  // steps
constexpr unsigned steps_to_break = 4;
constexpr double alike = 1e-6;  // of the demand: mirror images break together

}  // namespace

std::vector<LoadedBond> first_to_break(const std::vector<LoadedBond>& failing) {
  std::unordered_map<std::uint32_t, double> taken;  // demand of the first bond of a family
  std::vector<LoadedBond> result;
  for (const auto& one : failing) {
    const auto free = [&](std::uint32_t k) {
      const auto entry = taken.find(k);
      return entry == taken.end() || one.demand >= (1 - alike) * entry->second;
    };
    if (!free(one.bond[0]) || !free(one.bond[1])) continue;
    for (const auto k : one.bond) taken.try_emplace(k, one.demand);
    result.push_back(one);
  }
  return result;
}

BreakingBonds::BreakingBonds(SeveredPlate& plate, BondCheck& check, Observe observe)
    : plate_(plate), check_(check), observe_(std::move(observe)) {}

void BreakingBonds::before_force(const plate::Step& now) {
  spent_ += plate_.carry_on_all({now.state, now.velocity, now.time_step});
}

void BreakingBonds::after_force(const plate::Step& now, const plate::Forces&) {
  if (ended_) return;
  if (now.step >= next_search_) {
    suspects_ = check_.suspects(now.state);
    next_search_ = now.step + search_every;
  }
  if (suspects_.empty()) return;
  const auto broken = first_to_break(check_.at_least(1, now.state, suspects_));
  if (broken.empty()) return;
  std::vector<PointPair> bonds;
  for (const auto& one : broken) bonds.push_back(one.bond);
  plate_.sever(bonds, steps_to_break);
  ended_ = !observe_(broken, now.time);
}

}  // namespace fracture
