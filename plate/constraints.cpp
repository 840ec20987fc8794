#include "plate/constraints.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

namespace plate {

void Constraints::fix(std::uint32_t dof) { fixed_.push_back(dof); }

void Constraints::tie(std::uint32_t follower, std::uint32_t leader, double factor) {
  ties_.push_back({follower, leader, factor});
}

void Constraints::resolve() {
  std::unordered_map<std::uint32_t, Tie> by_follower;
  for (const Tie& tie : ties_) by_follower.try_emplace(tie.follower, tie);
  std::unordered_set<std::uint32_t> fixed(fixed_.begin(), fixed_.end());

  std::vector<Tie> resolved;
  for (const auto& [follower, first] : by_follower) {
    if (fixed.contains(follower)) continue;
    Tie tie = first;
    for (std::size_t links = 0; !fixed.contains(tie.leader); ++links) {
      const auto next = by_follower.find(tie.leader);
      if (next == by_follower.end()) break;
      tie = {follower, next->second.leader, tie.factor * next->second.factor};
      if (tie.leader == follower || links > by_follower.size()) tie.factor = 0;  // a ring of ties holds all at zero
      if (tie.factor == 0) break;
    }
    if (tie.factor == 0 || fixed.contains(tie.leader))
      fixed.insert(follower);
    else
      resolved.push_back(tie);
  }
  std::sort(resolved.begin(), resolved.end(), [](const Tie& a, const Tie& b) { return a.follower < b.follower; });
  ties_ = std::move(resolved);
  fixed_.assign(fixed.begin(), fixed.end());
  std::sort(fixed_.begin(), fixed_.end());

  held_ = fixed_;
  for (const Tie& tie : ties_) held_.push_back(tie.follower);
  std::sort(held_.begin(), held_.end());
}

bool Constraints::held(std::uint32_t dof) const { return std::binary_search(held_.begin(), held_.end(), dof); }

void Constraints::impose(State& state) const {
  for (const auto dof : fixed_) state.data()[dof] = 0;
  for (const Tie& tie : ties_) state.data()[tie.follower] = tie.factor * state.data()[tie.leader];
}

template <typename Weight>
void Constraints::fold_with(Forces& forces, const Weight& weight) const {
  for (const Tie& tie : ties_) {
    forces.data()[tie.leader] += weight(tie.factor) * forces.data()[tie.follower];
    forces.data()[tie.follower] = 0;
  }
  for (const auto dof : fixed_) forces.data()[dof] = 0;
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
