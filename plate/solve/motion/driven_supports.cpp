#include "plate/solve/motion/driven_supports.hpp"

#include <map>

#include "plate/formulation/constraints.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/settled.hpp"

namespace plate {

DrivenSupports::DrivenSupports(const std::vector<TimedLoad>& loads, const Constraints& constraints, const Forces& mass,
                               const Forces& folded) {
  std::map<std::uint32_t, std::vector<double>> lifts;
  for (std::size_t l = 0; l < loads.size(); ++l) {
    if (!loads[l].lifts()) continue;
    for (const auto dof : constraints.held())
      if (const double value = at_dof(loads[l].lift, dof); value != 0)
        lifts.try_emplace(dof, loads.size(), 0.0).first->second[l] = value;
  }
  if (lifts.empty()) return;
  for (const auto& load : loads) histories_.push_back(load.history);
  std::map<std::uint32_t, std::size_t> leader_of;
  for (auto& [dof, values] : lifts) driven_.push_back({dof, at_dof(mass, dof), std::move(values)});
  auto tie = constraints.ties().begin();
  for (auto& one : driven_) {
    while (tie != constraints.ties().end() && tie->follower < one.dof) ++tie;
    for (; tie != constraints.ties().end() && tie->follower == one.dof; ++tie) {
      const auto [found, fresh] = leader_of.try_emplace(tie->leader, leaders_.size());
      if (const double m = at_dof(folded, tie->leader); fresh) leaders_.push_back({tie->leader, m > 0 ? 1 / m : 0});
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
  return settles(plate) ? whole_mass(plate, rotary) : Forces(3, 0);
}

void DrivenSupports::at(double time, double time_step, bool first) {
  time_ = time, dt_ = time_step;
  const auto place = [&](const Driven& one, double when) {
    double sum = 0;
    for (std::size_t l = 0; l < histories_.size(); ++l)
      if (one.lifts[l] != 0) sum += factor(histories_[l], when) * one.lifts[l];
    return sum;
  };
  for (auto& one : driven_) {
    one.now = place(one, time), one.next = place(one, time + time_step);
    one.before = first ? one.next : place(one, time - time_step);  // from rest: u(dt) = a dt^2 / 2
    one.speed = (one.next - one.before) / (2 * dt_);
    one.acceleration = (one.next - 2 * one.now + one.before) / (dt_ * dt_);
  }
}

void DrivenSupports::place_next(State& state) const {
  for (const auto& one : driven_) at_dof(state, one.dof) += one.next;
}

template <typename Real>
void DrivenSupports::take(Values<Real>& force) {
  for (auto& one : driven_) {
    auto& own = at_dof(force, one.dof);
    one.force = double(own);
    own -= Real(one.mass * one.acceleration);
  }
}

template void DrivenSupports::take(Values<double>&);
template void DrivenSupports::take(Values<float>&);

template <typename Real>
void DrivenSupports::book(const State& state, const State& velocity, const Values<Real>& folded, double half) {
  for (auto& leader : leaders_) {
    double force = double(at_dof(folded, leader.dof));
    for (std::size_t l = 0; l < histories_.size(); ++l) force += factor(histories_[l], time_) * leader.loads[l];
    leader.acceleration = force * leader.inverse_mass;
    leader.velocity = at_dof(velocity, leader.dof) + half * leader.acceleration;
  }
  for (auto& one : driven_) {
    one.follows_at = at_dof(state, one.dof) - one.now, one.follows_speed = one.follows_acceleration = 0;
    for (const auto& [leader, factor] : one.leaders) {
      one.follows_speed += factor * leaders_[leader].velocity;
      one.follows_acceleration += factor * leaders_[leader].acceleration;
    }
    const double reaction = one.mass * (one.acceleration + one.follows_acceleration) - one.force;
    if (booked_)
      work_ += (reaction + one.reaction) / 2 * (one.now - one.booked_at);
    else if (slow_)
      work_ += reaction * one.now / 2;
    one.reaction = reaction, one.booked_at = one.now;
  }
  booked_ = true;
}

template void DrivenSupports::book(const State&, const State&, const Values<double>&, double);
template void DrivenSupports::book(const State&, const State&, const Values<float>&, double);

void DrivenSupports::complete(Instant& seen) const {
  if (!any()) return;
  seen.external_work += work_;
  for (const auto& one : driven_) {
    const double speed = one.follows_speed + one.speed, change = dt_ / 2 * one.follows_acceleration,
                 whole_change = dt_ / 2 * (one.follows_acceleration + one.acceleration);
    const double kinetic = one.mass / 2 * (speed * speed - one.follows_speed * one.follows_speed);
    seen.kinetic_energy += kinetic;
    seen.discrete_kinetic_energy += kinetic - one.mass / 2 * (whole_change * whole_change - change * change);
    seen.strain_energy -= (one.mass * one.acceleration * one.follows_at + one.force * one.now) / 2;
  }
  const auto add = [](std::function<State()> free, const DrivenSupports& supports, double Driven::*own) {
    return [free = std::move(free), &supports, own] {
      State whole = free();
      for (const auto& one : supports.driven_) at_dof(whole, one.dof) += one.*own;
      return whole;
    };
  };
  seen.velocity = add(std::move(seen.velocity), *this, &Driven::speed);
  seen.acceleration = add(std::move(seen.acceleration), *this, &Driven::acceleration);
}

std::vector<double> DrivenSupports::memory() const {
  std::vector<double> result;
  if (!any()) return result;
  result.push_back(work_);
  for (const auto& one : driven_) result.push_back(one.reaction), result.push_back(one.booked_at);
  return result;
}

void DrivenSupports::recall(const std::vector<double>& memory) {
  if (memory.empty()) return;
  work_ = memory.front(), booked_ = true;
  for (std::size_t i = 0; i < driven_.size(); ++i)
    driven_[i].reaction = memory[2 * i + 1], driven_[i].booked_at = memory[2 * i + 2];
}

void DrivenSupports::start() {
  slow_ = true;
}

}  // namespace plate
