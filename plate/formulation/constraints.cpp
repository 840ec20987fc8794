#include "plate/formulation/constraints.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_set>

#include "plate/model/halo_exchange.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"

namespace plate {
namespace {

using Wanted = std::unordered_map<Dof, std::vector<Constraints::Leader>>;
using Offsets = std::unordered_map<Dof, std::vector<Constraints::Offset>>;

/// Expansion of a degree of freedom in free ones and in motions of supports.
struct Expanded {
  std::map<Dof, double> free;
  std::map<std::size_t, double> motions;
};

/// Prescribed constraints of all held degrees of freedom.
struct Rules {
  const Wanted& wanted;
  const std::unordered_set<Dof>& fixed;
  const Offsets &of_fixed, &of_ties;
};

void add(const Offsets& offsets, const Dof& dof, double factor, Expanded& sum) {
  if (const auto entry = offsets.find(dof); entry != offsets.end())
    for (const auto& [motion, value] : entry->second) sum.motions[motion] += factor * value;
}

/// Adds factor * u[dof] to `sum`, in terms of free degrees of freedom. A chain longer than any sound one is a ring: it
/// holds at zero what it ties.
void expand(const Dof& dof, double factor, const Rules& rules, Expanded& sum, int depth) {
  constexpr int longest_chain = 16;
  if (factor == 0 || depth > longest_chain) return;
  if (rules.fixed.contains(dof)) return add(rules.of_fixed, dof, factor, sum);
  const auto entry = rules.wanted.find(dof);
  if (entry == rules.wanted.end()) {
    sum.free[dof] += factor;
    return;
  }
  add(rules.of_ties, dof, factor, sum);
  for (const auto& leader : entry->second) expand(leader.dof, factor * leader.factor, rules, sum, depth + 1);
}

}  // namespace

void Constraints::fix(const Dof& dof, std::vector<Offset> offsets) {
  fixed_.push_back(dof);
  if (!offsets.empty()) of_fixed_.try_emplace(dof, std::move(offsets));
}

void Constraints::tie(const Dof& follower, std::vector<Leader> leaders, std::vector<Offset> offsets) {
  if (wanted_.try_emplace(follower, std::move(leaders)).second && !offsets.empty())
    of_ties_.try_emplace(follower, std::move(offsets));
}

void Constraints::add(const Constraints& others, std::uint32_t first) {
  const auto moved = [&](const Dof& one) { return Dof{first + one.point, one.component}; };
  for (const auto& fixed : others.fixed()) fix(moved(fixed));
  const auto& ties = others.ties();  // ascending by follower
  for (std::size_t i = 0; i < ties.size();) {
    const auto follower = ties[i].follower;
    std::vector<Leader> leaders;
    for (; i < ties.size() && ties[i].follower == follower; ++i)
      leaders.push_back({moved(ties[i].leader), ties[i].factor});
    tie(moved(follower), std::move(leaders));
  }
}

void Constraints::resolve() {
  std::unordered_set<Dof> fixed(fixed_.begin(), fixed_.end());
  std::vector<Dof> zero;
  const Rules rules{wanted_, fixed, of_fixed_, of_ties_};
  const auto moved = [&](const Dof& dof, const Expanded& sum) {
    for (const auto& [motion, value] : sum.motions)
      if (value != 0) lifts_[motion].push_back({dof, value});
  };
  for (const auto& [dof, offsets] : of_fixed_) {
    Expanded sum;
    expand(dof, 1, rules, sum, 0);
    moved(dof, sum);
  }
  for (const auto& [follower, leaders] : wanted_) {
    if (fixed.contains(follower)) continue;
    Expanded sum;
    expand(follower, 1, rules, sum, 0);
    for (const auto& [leader, factor] : sum.free) ties_.push_back({follower, leader, factor});
    if (sum.free.empty()) zero.push_back(follower);
    moved(follower, sum);
  }
  wanted_.clear(), of_fixed_.clear(), of_ties_.clear();
  fixed.insert(zero.begin(), zero.end());
  fixed_.assign(fixed.begin(), fixed.end());
  std::sort(fixed_.begin(), fixed_.end());
  std::sort(ties_.begin(), ties_.end(), [](const Tie& a, const Tie& b) {
    return a.follower != b.follower ? a.follower < b.follower : a.leader < b.leader;
  });

  held_ = fixed_;
  for (const Tie& tie : ties_) held_.push_back(tie.follower);
  std::sort(held_.begin(), held_.end());
  held_.erase(std::unique(held_.begin(), held_.end()), held_.end());
  zero_ = fixed_;
  followers_ = sums(ties_, false), leaders_ = sums(ties_, true);
}

void Constraints::tie_more(std::vector<std::pair<Dof, std::vector<Leader>>> ties) {
  for (const Tie& old : ties_) wanted_[old.follower].push_back({old.leader, old.factor});
  ties_.clear();
  for (auto& [follower, leaders] : ties) tie(follower, std::move(leaders));
  resolve();
}

Constraints::Sums Constraints::sums(const std::vector<Tie>& ties, bool by_leader) {
  const auto target = [&](const Tie& tie) { return by_leader ? tie.leader : tie.follower; };
  std::vector<Tie> sorted = ties;
  std::stable_sort(sorted.begin(), sorted.end(), [&](const Tie& a, const Tie& b) { return target(a) < target(b); });
  Sums result;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const auto to = target(sorted[i]), from = by_leader ? sorted[i].follower : sorted[i].leader;
    if (i == 0 || to != target(sorted[i - 1])) {
      result.target.push_back(to);
      result.first.push_back(i);
    }
    result.shares.push_back({from, sorted[i].factor});
    result.first.back() = i + 1;
  }
  return result;
}

State Constraints::lift(std::size_t motion, std::size_t points) const {
  const auto found = lifts_.find(motion);
  if (found == lifts_.end()) return no_state();
  State result = zero_state(points);
  for (const auto& [dof, value] : found->second) at_dof(result, dof) = value;
  return result;
}

std::vector<Constraints::Leader> Constraints::lifted(std::size_t motion) const {
  const auto found = lifts_.find(motion);
  return found == lifts_.end() ? std::vector<Leader>() : found->second;
}

bool Constraints::held(const Dof& dof) const {
  return std::binary_search(held_.begin(), held_.end(), dof);
}

namespace {

/// Calls visit(target, sum of weight * value) for all targets, from several threads where they are many.
template <typename Sums, typename Real, typename Weight, typename Visit>
void for_each_sum(const Sums& sums, const Values<Real>& values, const Weight& weight, const Visit& visit) {
  constexpr std::size_t many = 2000;
#pragma omp parallel for schedule(static) if (sums.target.size() > many)
  for (std::size_t t = 0; t < sums.target.size(); ++t) {
    Real sum = 0;
    for (std::size_t i = sums.first[t]; i < sums.first[t + 1]; ++i) {
      const auto& share = sums.shares[i];
      sum += Real(weight(share.factor)) * at_dof(values, share.from);
    }
    visit(sums.target[t], sum);
  }
}

}  // namespace

int Constraints::rank() const {
  return communicator_->rank();
}

bool Constraints::distributed() const {
  return communicator_->distributed();
}

void Constraints::share(const Communicator& communicator, std::vector<std::uint32_t> ghosts,
                        std::shared_ptr<const HaloExchange> exchange) {
  communicator_ = &communicator, copies_ = std::move(ghosts), exchange_ = std::move(exchange);
  const std::unordered_set<std::uint32_t> copied(copies_.begin(), copies_.end());
  std::erase_if(zero_, [&](const Dof& dof) {
    const bool pending = copied.contains(dof.point);
    if (pending) pending_zero_.push_back(dof);
    return pending;
  });
  std::vector<Tie> own, pending;
  for (std::size_t i = 0, end = 0; i < ties_.size(); i = end) {
    bool waits = copied.contains(ties_[i].follower.point);
    for (end = i; end < ties_.size() && ties_[end].follower == ties_[i].follower; ++end)
      waits = waits || copied.contains(ties_[end].leader.point);
    auto& sum = waits ? pending : own;
    sum.insert(sum.end(), ties_.begin() + std::ptrdiff_t(i), ties_.begin() + std::ptrdiff_t(end));
  }
  followers_ = sums(own, false), pending_followers_ = sums(pending, false);
}

void Constraints::share_stacked(const Constraints& plate, const Constraints& plane, std::size_t points) {
  if (!plate.distributed()) return;
  constexpr int bits = 32;  // of a number at its owner; the rank of the owner stands above
  const auto own = std::int64_t(plate.rank());
  std::vector<std::int64_t> owners(points);
  for (std::size_t k = 0; k < points; ++k) owners[k] = own << bits | std::int64_t(k);
  for (const auto k : plate.copies_) owners[k] = -1;
  auto of_plane = owners;
  plate.fetch(owners), plane.fetch(of_plane);
  const auto points_of = gathered(*plate.communicator_, std::vector<std::uint32_t>{std::uint32_t(points)});
  std::vector<std::uint32_t> ghosts = plate.copies_;
  for (const auto k : plate.copies_) ghosts.push_back(std::uint32_t(points) + k);
  std::vector<Copy> copies;
  for (const std::uint32_t part : {0U, 1U})
    for (const auto k : plate.copies_)
      if (const auto there = std::max(owners[k], of_plane[k]); there >= 0) {
        const auto owner = std::size_t(there >> bits);
        copies.push_back({part * std::uint32_t(points) + k, int(owner),
                          part * points_of[owner] + std::uint32_t(there & 0xffffffff)});
      }
  share(*plate.communicator_, std::move(ghosts), plate.communicator_->halo_exchange(2 * points, copies));
}

Constraints stacked(const Constraints& plate, const Constraints& plane, std::size_t points) {
  Constraints result;
  result.add(plate, 0), result.add(plane, std::uint32_t(points));
  result.resolve();
  result.share_stacked(plate, plane, points);
  return result;
}

Constraints Constraints::fixing(const std::vector<Dof>& more) const {
  Constraints result;
  result.add(*this, 0);
  for (const auto& dof : more) result.fix(dof);
  result.resolve();
  if (distributed()) result.share(*communicator_, copies_, exchange_);
  return result;
}

Constraints Constraints::fetching(std::shared_ptr<const HaloExchange> exchange) const {
  Constraints result = *this;
  result.exchange_ = std::move(exchange);
  return result;
}

template <typename Real>
void Constraints::fetch(Values<Real>& values) const {
  if (exchange_) exchange_->fetch(std::span(values.data(), std::size_t(values.size())));
}

template void Constraints::fetch(Values<double>&) const;

void Constraints::fetch(std::vector<std::int64_t>& numbers) const {
  if (exchange_) exchange_->fetch(numbers);
}

template <typename Real, typename Weight>
void Constraints::impose_own(Values<Real>& state, const Weight& weight) const {
  if (exchange_) exchange_->start(std::span(state.data(), std::size_t(state.size())));
  for (const auto& dof : zero_) at_dof(state, dof) = 0;
  for_each_sum(followers_, state, weight, [&](const Dof& to, Real sum) { at_dof(state, to) = sum; });
}

template <typename Real, typename Weight>
void Constraints::impose_pending(Values<Real>& state, const Weight& weight) const {
  if (!exchange_) return;
  exchange_->finish();
  for (const auto& dof : pending_zero_) at_dof(state, dof) = 0;
  for_each_sum(pending_followers_, state, weight, [&](const Dof& to, Real sum) { at_dof(state, to) = sum; });
}

template <typename Real, typename Weight>
void Constraints::impose_with(Values<Real>& state, const Weight& weight) const {
  impose_own(state, weight);
  impose_pending(state, weight);
}

namespace {

double itself(double factor) {
  return factor;
}

}  // namespace

void Constraints::impose(State& state) const {
  impose_with(state, itself);
}

void Constraints::impose(Values<float>& state) const {
  impose_with(state, itself);
}

void Constraints::begin_imposing(State& state) const {
  impose_own(state, itself);
}

void Constraints::progress() const {
  if (exchange_) exchange_->progress();
}

void Constraints::end_imposing(State& state) const {
  impose_pending(state, itself);
}

std::vector<char> Constraints::pending(std::size_t points) const {
  std::vector<char> result(exchange_ ? points : 0, 0);
  if (!exchange_) return result;
  for (const auto k : copies_) result[k] = 1;
  for (const auto& dof : pending_followers_.target) result[dof.point] = 1;
  return result;
}

void Constraints::impose_absolute(State& state) const {
  impose_with(state, [](double factor) { return std::abs(factor); });
}

namespace {

template <typename Real>
Eigen::VectorXd picked(const Values<Real>& forces, const std::vector<Dof>& dofs) {
  Eigen::VectorXd result{Eigen::Index(dofs.size())};
  for (std::size_t i = 0; i < dofs.size(); ++i) result[Eigen::Index(i)] = double(at_dof(forces, dofs[i]));
  return result;
}

}  // namespace

Eigen::VectorXd Constraints::on_held(const Forces& forces) const {
  return picked(forces, held_);
}

Eigen::VectorXd Constraints::on_held(const Values<float>& forces) const {
  return picked(forces, held_);
}

template <typename Real, typename Weight>
void Constraints::fold_with(Values<Real>& forces, const Weight& weight) const {
  for_each_sum(leaders_, forces, weight, [&](const Dof& to, Real sum) { at_dof(forces, to) += sum; });
  for (const auto* dofs : {&zero_, &followers_.target, &pending_followers_.target})
    for (const auto& dof : *dofs) at_dof(forces, dof) = 0;
  for (const auto point : copies_) forces.col(point).setZero();
}

void Constraints::fold(Forces& forces) const {
  fold_with(forces, itself);
}

void Constraints::fold(Values<float>& forces) const {
  fold_with(forces, itself);
}

void Constraints::fold_absolute(Forces& forces) const {
  fold_with(forces, [](double factor) { return std::abs(factor); });
}

void Constraints::fold_diagonal(Forces& diagonal) const {
  fold_with(diagonal, [](double factor) { return factor * factor; });
}

}  // namespace plate
