#include "plate/solve/motion/driven_supports.hpp"

#include <cmath>
#include <map>

#include "plate/formulation/constraints.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"
#include "plate/solve/motion/contact_and_damping.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/prescribed_displacements.hpp"

namespace plate {

DrivenSupports::DrivenSupports(const std::vector<TimedLoad>& loads, const Constraints& constraints, const Forces& mass,
                               const Forces& folded, const std::vector<char>& own)
    : constraints_(&constraints), any_(std::ranges::any_of(loads, &TimedLoad::lifts)) {
  const auto owns = [&](const Dof& dof) { return own.empty() || own[dof.point]; };
  std::map<Dof, std::vector<double>> lifts;
  for (std::size_t l = 0; l < loads.size(); ++l) {
    if (!loads[l].lifts()) continue;
    for (const auto dof : constraints.held())
      if (const double value = at_dof(loads[l].lift, dof); value != 0)
        lifts.try_emplace(dof, loads.size(), 0.0).first->second[l] = value;
  }
  if (lifts.empty()) return;
  for (const auto& load : loads) histories_.push_back(load.history);
  std::map<Dof, std::size_t> leader_of;
  for (auto& [dof, values] : lifts) driven_.push_back({dof, owns(dof), at_dof(mass, dof), std::move(values)});
  auto tie = constraints.ties().begin();
  for (auto& one : driven_) {
    while (tie != constraints.ties().end() && tie->follower < one.dof) ++tie;
    for (; tie != constraints.ties().end() && tie->follower == one.dof; ++tie) {
      const auto [found, fresh] = leader_of.try_emplace(tie->leader, leaders_.size());
      const double m = at_dof(folded, tie->leader);
      if (fresh) leaders_.push_back({tie->leader, bool(owns(tie->leader)), m > 0 ? 1 / m : 0});
      one.leaders.emplace_back(found->second, tie->factor);
    }
  }
  for (const auto& load : loads) {
    Forces forces = load.forces;
    constraints.fold(forces);
    for (auto& leader : leaders_) leader.loads.push_back(at_dof(forces, leader.dof));
  }
}

Forces driven_mass(const Formulation& plate, double rotary) {
  return has_prescribed_displacements(plate) ? unconstrained_mass(plate, rotary) : Forces();
}

double DrivenSupports::place_of(const Driven& one, double time) const {
  double sum = 0;
  for (std::size_t l = 0; l < histories_.size(); ++l)
    if (one.lifts[l] != 0) sum += factor(histories_[l], time) * one.lifts[l];
  return sum;
}

void DrivenSupports::at(double time, double time_step, bool first) {
  time_ = time, dt_ = time_step;
  const double step = std::round(time / time_step);  // every step sees the same places at the same times
  for (auto& one : driven_) {
    one.now = place_of(one, time), one.next = place_of(one, (step + 1) * time_step);
    one.before = first ? one.next : place_of(one, (step - 1) * time_step);  // from rest: u(dt) = a dt^2 / 2
    one.speed = (one.next - one.before) / (2 * dt_);
    one.acceleration = (one.next - 2 * one.now + one.before) / (dt_ * dt_);
    one.strained = first ? 0 : (one.now - one.before) / dt_;
  }
}

void DrivenSupports::place_next(State& state) const {
  for (const auto& one : driven_) at_dof(state, one.dof) += one.next;
}

void DrivenSupports::place(State& state, double time) const {
  for (const auto& one : driven_) at_dof(state, one.dof) += place_of(one, time);
}

/// Sums of what `terms` adds for everything that is held: of itself, where that is the process's own, and of the
/// leaders that are, with their share of its mass.
template <std::size_t N, typename Terms>
std::array<double, N> DrivenSupports::sum(const Terms& terms) const {
  const auto each = [&](std::size_t i, const auto& add) {
    const auto& one = driven_[i];
    if (one.own) terms.of_itself(one, add);
    for (const auto& [leader, factor] : one.leaders)
      if (leaders_[leader].own) terms.of_leader(one, one.mass * factor, leaders_[leader], add);
  };
  return sum_of_items<N>(*constraints_, driven_.size(), each);
}

void DrivenSupports::leave_out(State& state) const {
  for (const auto& one : driven_) at_dof(state, one.dof) -= one.now;
}

template <typename Real>
void DrivenSupports::take(Values<Real>& force, const ContactAndDamping& beside) {
  const auto& [alpha, beta] = beside.damping();
  for (auto& one : driven_) {
    auto& own = at_dof(force, one.dof);
    const auto i = Eigen::Index(index_in_state(one.dof, std::size_t(force.cols())));
    one.force = double(own), one.beside = beside.force(i);
    one.inertia = one.mass * (one.acceleration + alpha * one.speed);
    one.drag = alpha * one.mass * one.speed - beside.viscous(i);
    one.strained *= beta;
    own -= Real(one.inertia);
  }
}

template void DrivenSupports::take(Values<double>&, const ContactAndDamping&);
template void DrivenSupports::take(Values<float>&, const ContactAndDamping&);

namespace {

template <typename OfItself, typename OfLeader>
struct Terms {
  OfItself of_itself;
  OfLeader of_leader;
};
template <typename OfItself, typename OfLeader>
Terms(OfItself, OfLeader) -> Terms<OfItself, OfLeader>;  // clang 16 deduces none

}  // namespace

template <typename Real>
void DrivenSupports::add_work(const Step& step, const Values<Real>& folded, const ContactAndDamping& beside) {
  if (!any()) return;
  const double alpha = beside.damping().mass, half = step.step == 0 ? 0 : dt_ / 2;
  for (auto& leader : leaders_) {
    if (!leader.own) continue;
    const auto i = Eigen::Index(index_in_state(leader.dof, std::size_t(folded.cols())));
    double force = double(folded.data()[i]) + beside.force(i);
    for (std::size_t l = 0; l < histories_.size(); ++l) force += factor(histories_[l], time_) * leader.loads[l];
    const double v = step.velocity.data()[i];
    leader.acceleration = force * leader.inverse_mass;
    if (alpha > 0) leader.acceleration = (leader.acceleration - alpha * v) / (1 + alpha * dt_ / 2);
    leader.velocity = v + half * leader.acceleration;
    leader.since = 2 * half * v, leader.ahead = dt_ * (v + (dt_ / 2 + half) * leader.acceleration);
  }
  for (auto& one : driven_) one.follows_at = at_dof(step.state, one.dof) - one.now;
  const auto on_the_way = [](const Driven& one, double reaction, const auto& add) {
    add(0, reaction * (one.now - one.before)), add(1, reaction * (one.next - one.now));
  };
  const auto [since, ahead, slowly] =
      sum<3>(Terms{[&](const Driven& one, const auto& add) {
                     on_the_way(one, one.inertia - one.force - one.beside, add);
                     add(2, -one.force * one.now);  // slowly: neither inertia nor damping
                   },
                   [&](const Driven& one, double mass, const Leader& leader, const auto& add) {
                     on_the_way(one, mass * (leader.acceleration + alpha * leader.velocity), add);
                   }});
  if (beside.damps()) add_losses(alpha);
  if (counted_)
    work_ += (since + ahead_) / 2;
  else if (slow_)
    work_ += slowly / 2;
  ahead_ = ahead, counted_ = true;
}

template void DrivenSupports::add_work(const Step&, const Values<double>&, const ContactAndDamping&);
template void DrivenSupports::add_work(const Step&, const Values<float>&, const ContactAndDamping&);

/// The damping force on the whole velocity, along the way of what is held, and its part by the speed of that along the
/// way of what leads.
void DrivenSupports::add_losses(double mass_damping) {
  const auto [since, ahead] =
      sum<2>(Terms{[](const Driven& one, const auto& add) {
                     add(0, one.drag * (one.now - one.before)), add(1, one.drag * (one.next - one.now));
                   },
                   [&](const Driven& one, double mass, const Leader& leader, const auto& add) {
                     const double drag = mass_damping * mass;
                     add(0, drag * (leader.velocity * (one.now - one.before) + one.speed * leader.since));
                     add(1, drag * (leader.velocity * (one.next - one.now) + one.speed * leader.ahead));
                   }});
  if (counted_) dissipated_ += (since + lost_ahead_) / 2;
  lost_ahead_ = ahead;
}

void DrivenSupports::complete(Instant& seen) const {
  if (!any()) return;
  seen.external_work += work_, seen.dissipated += dissipated_;
  const auto [kinetic, of_change, strain] =
      sum<3>(Terms{[](const Driven& one, const auto& add) {
                     add(0, one.mass / 2 * one.speed * one.speed);
                     add(1, one.mass / 2 * one.acceleration * one.acceleration);
                     add(2, (one.inertia * one.follows_at + one.force * one.now) / 2);
                   },
                   [](const Driven& one, double mass, const Leader& leader, const auto& add) {
                     add(0, mass * leader.velocity * one.speed), add(1, mass * leader.acceleration * one.acceleration);
                   }});
  seen.kinetic_energy += kinetic;
  seen.discrete_kinetic_energy += kinetic - dt_ * dt_ / 4 * of_change;
  seen.strain_energy -= strain;
  const auto add = [](std::function<State()> free, const DrivenSupports& supports, double Driven::*own) {
    return [free = std::move(free), &supports, own] {
      State whole = free();
      for (const auto& one : supports.driven_) at_dof(whole, one.dof) += one.*own;
      return whole;
    };
  };
  seen.velocity = add(std::move(seen.velocity), *this, &Driven::speed);
  seen.acceleration = add(std::move(seen.acceleration), *this, &Driven::acceleration);
  if (seen.strained) seen.strained = add(std::move(seen.strained), *this, &Driven::strained);
}

std::vector<double> DrivenSupports::memory() const {
  return any() ? std::vector<double>{work_, ahead_, dissipated_, lost_ahead_} : std::vector<double>{};
}

void DrivenSupports::restore(const std::vector<double>& memory) {
  if (memory.empty()) return;
  work_ = memory[0], ahead_ = memory[1], dissipated_ = memory[2], lost_ahead_ = memory[3], counted_ = true;
}

void DrivenSupports::start() {
  slow_ = true;
}

}  // namespace plate
