#include "fracture/growth/motion/breaking_bonds.hpp"

#include <unordered_map>

#include "plate/solve/reduction.hpp"

namespace fracture {
namespace {

constexpr std::size_t search_every = 4;  // steps
constexpr unsigned steps_to_break = 4;
constexpr double equal_demand = 1e-6;  // of the demand: mirror images break together

}  // namespace

std::vector<LoadedBond> first_to_break(const std::vector<LoadedBond>& failing) {
  std::unordered_map<std::uint32_t, double> taken;  // demand of the first bond of a family
  std::vector<LoadedBond> result;
  for (const auto& one : failing) {
    const auto free = [&](std::uint32_t k) {
      const auto entry = taken.find(k);
      return entry == taken.end() || one.demand >= (1 - equal_demand) * entry->second;
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
  if (plate_.easing()) plate_.constraints().fetch(now.velocity);
  spent_ += plate_.carry_on_all({now.state, now.velocity, now.time_step});
}

void BreakingBonds::after_force(const plate::Step& now, const plate::Forces&) {
  if (ended_) return;
  if (now.step >= next_search_) {
    suspects_ = check_.suspects(now.state);
    suspected_ = plate::largest_of_all(!suspects_.empty()) > 0;
    next_search_ = now.step + search_every;
  }
  if (!suspected_) return;
  const auto broken = first_to_break(check_.at_least(1, now.state, suspects_));
  if (broken.empty()) return;
  plate_.sever(check_.here(broken), steps_to_break);
  ended_ = !observe_(broken, now.time);
}

}  // namespace fracture
