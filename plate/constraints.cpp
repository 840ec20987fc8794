#include "plate/constraints.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_set>

namespace plate {
namespace {

using Wanted = std::unordered_map<std::uint32_t, std::vector<Constraints::Leader>>;

/// Adds factor * u[dof] to `sum`, in terms of free degrees of freedom. A chain longer than any sound one is a ring: it
/// holds at zero what it ties.
void expand(std::uint32_t dof, double factor, const Wanted& wanted, const std::unordered_set<std::uint32_t>& fixed,
            std::map<std::uint32_t, double>& sum, int depth) {
  constexpr int longest_chain = 16;
  if (factor == 0 || fixed.contains(dof) || depth > longest_chain) return;
  const auto entry = wanted.find(dof);
  if (entry == wanted.end()) {
    sum[dof] += factor;
    return;
  }
  for (const auto& leader : entry->second) expand(leader.dof, factor * leader.factor, wanted, fixed, sum, depth + 1);
}

}  // namespace

void Constraints::fix(std::uint32_t dof) { fixed_.push_back(dof); }

void Constraints::tie(std::uint32_t follower, std::vector<Leader> leaders) {
  wanted_.try_emplace(follower, std::move(leaders));
}

void Constraints::resolve() {
  std::unordered_set<std::uint32_t> fixed(fixed_.begin(), fixed_.end());
  std::vector<std::uint32_t> zero;
  for (const auto& [follower, leaders] : wanted_) {
    if (fixed.contains(follower)) continue;
    std::map<std::uint32_t, double> sum;
    expand(follower, 1, wanted_, fixed, sum, 0);
    for (const auto& [leader, factor] : sum) ties_.push_back({follower, leader, factor});
    if (sum.empty()) zero.push_back(follower);
  }
  wanted_.clear();
  fixed.insert(zero.begin(), zero.end());
  fixed_.assign(fixed.begin(), fixed.end());
  std::sort(fixed_.begin(), fixed_.end());
  std::sort(ties_.begin(), ties_.end(), [](const Tie& a, const Tie& b) {
    return a.follower != b.follower ? a.follower < b.follower : a.leader < b.leader;
  });

  held_ = fixed_;
  for (const Tie& tie : ties_) held_.push_back(tie.follower);
  std::sort(held_.begin(), held_.end());
}

bool Constraints::held(std::uint32_t dof) const { return std::binary_search(held_.begin(), held_.end(), dof); }

template <typename Weight>
void Constraints::impose_with(State& state, const Weight& weight) const {
  for (const auto dof : held_) at_dof(state, dof) = 0;
  for (const Tie& tie : ties_) at_dof(state, tie.follower) += weight(tie.factor) * at_dof(state, tie.leader);
}

void Constraints::impose(State& state) const {
  impose_with(state, [](double factor) { return factor; });
}

void Constraints::impose_absolute(State& state) const {
  impose_with(state, [](double factor) { return std::abs(factor); });
}

template <typename Weight>
void Constraints::fold_with(Forces& forces, const Weight& weight) const {
  for (const Tie& tie : ties_) at_dof(forces, tie.leader) += weight(tie.factor) * at_dof(forces, tie.follower);
  for (const auto dof : held_) at_dof(forces, dof) = 0;
}

void Constraints::fold(Forces& forces) const {
  fold_with(forces, [](double factor) { return factor; });
}

void Constraints::fold_absolute(Forces& forces) const {
  fold_with(forces, [](double factor) { return std::abs(factor); });
}

void Constraints::fold_diagonal(Forces& diagonal) const {
  fold_with(diagonal, [](double factor) { return factor * factor; });
}

}  // namespace plate
