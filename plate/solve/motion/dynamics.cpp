#include "plate/solve/motion/dynamics.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/dense_algebra.hpp"
#include "plate/model/numerical_method.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"
#include "plate/solve/interruption.hpp"
#include "plate/solve/motion/contact_and_damping.hpp"
#include "plate/solve/motion/driven_supports.hpp"
#include "plate/solve/motion/masses_and_loads.hpp"
#include "plate/solve/plate_in_contact.hpp"
#include "plate/solve/validation.hpp"

namespace plate {
namespace {

/// Acceleration of a degree of freedom whose velocity is half a step before, or that of time 0.
template <typename Real>
auto acceleration_of(const Values<Real>& force, const State& velocity, const ContactAndDamping& contact_and_damping,
                     double time_step) {
  const double alpha = contact_and_damping.damping().mass, half = time_step / 2;
  return [&force, &velocity, &contact_and_damping, alpha, half](const PointClass& one, std::size_t c, Eigen::Index i) {
    const double free = (double(force.data()[i]) + contact_and_damping.force(i) + one.load[c]) * one.inverse_mass[c];
    return alpha > 0 ? (free - alpha * velocity.data()[i]) / (1 + alpha * half) : free;
  };
}

/// Losses to damping in the half steps before and after a step [energy].
template <typename Real>
std::array<double, 2> losses(const Step& now, const Values<Real>& force, const Masses& masses,
                             const ContactAndDamping& contact_and_damping) {
  const double dt = now.time_step, alpha = contact_and_damping.damping().mass;
  const auto acceleration = acceleration_of(force, now.velocity, contact_and_damping, dt);
  return masses.sum<2>(now.state.cols(), [&](const PointClass& one, std::size_t c, Eigen::Index i) {
    const double a = acceleration(one, c, i), v = now.velocity.data()[i], after = v + (now.step == 0 ? dt / 2 : dt) * a;
    const double drag = alpha * one.mass[c] * (v + dt / 2 * a) - contact_and_damping.viscous(i);
    return std::array<double, 2>{now.step == 0 ? 0 : dt / 2 * drag * v, dt / 2 * drag * after};
  });
}

/// Instant that observers receive of a step; all arguments must outlive it. `force`: folded.
template <typename Real>
Instant seen(const Step& now, const Values<Real>& force, double work, const Masses& masses,
             const Constraints& constraints, const ContactAndDamping& contact_and_damping) {
  const Eigen::Index points = now.state.cols();
  const double dt = now.time_step;
  // velocity at the full step: half a step on from the one before, none at the start
  const double half = now.step == 0 ? 0 : dt / 2;
  const auto acceleration = acceleration_of(force, now.velocity, contact_and_damping, dt);
  const auto [kinetic, product, potential,
              strain] = masses.sum<4>(points, [&](const PointClass& one, std::size_t c, Eigen::Index i) {
    const double a = acceleration(one, c, i), v = now.velocity.data()[i] + half * a, change = dt / 2 * a;
    return std::array<double, 4>{one.mass[c] * v * v / 2, one.mass[c] * (v * v - change * change) / 2,
                                 one.load[c] * now.state.data()[i], -double(force.data()[i]) * now.state.data()[i] / 2};
  });
  // at the start the drag is that of the velocity there, of which the first half step has half a step more
  const double whole = now.step == 0 ? 1 + contact_and_damping.damping().mass * dt / 2 : 1;
  // `first` and `share` of the acceleration
  const auto combined = [&masses, &constraints, acceleration, points](State first, double share) {
    masses.for_each(points, [&](const PointClass& one, std::size_t c, Eigen::Index begin, std::uint32_t length) {
      for (Eigen::Index i = begin; i < begin + length; ++i) first.data()[i] += share * acceleration(one, c, i);
    });
    constraints.impose(first);
    return first;
  };
  Instant result{now.step,   now.time,
                 now.state,  [combined, &velocity = now.velocity, half] { return combined(velocity, half); },
                 kinetic,    work,
                 strain,     product,
                 -potential, [combined, points, whole] { return combined(zero_state(points), whole); },
                 {}};
  if (const auto& contact = contact_and_damping.contact()) {
    result.kinetic_energy += contact->kinetic(half), result.strain_energy += contact->spring();
    result.discrete_kinetic_energy += contact->discrete_kinetic(half, dt);
    result.contact_force = contact->contact_force(half);
  }
  if (contact_and_damping.damping().stiffness > 0)
    result.strained = [&constraints, &contact_and_damping, &now] {
      auto [change, factor] = contact_and_damping.strains_by(now.velocity);
      constraints.impose(change);
      return State(now.state + factor * change);
    };
  return result;
}

/// Finds the forces between faces of cracks, with all other forces in hand.
template <typename Real>
void press_faces(const Step& now, const Values<Real>& force, const Masses& masses,
                 ContactAndDamping& contact_and_damping) {
  if (!contact_and_damping.faces().any()) return;
  const double dt = now.time_step;
  const auto acceleration = acceleration_of(force, now.velocity, contact_and_damping, dt);
  const auto of_dof = [&](const Dof& dof) {
    const auto i = Eigen::Index(index_in_state(dof, std::size_t(now.state.cols())));
    return acceleration(masses.at_point(dof.point), dof.component, i);
  };
  contact_and_damping.press_faces({.state = now.state,
                                   .velocity = now.velocity,
                                   .time_step = dt,
                                   .share = now.step == 0 ? dt / 2 : dt,
                                   .drag = 1 + contact_and_damping.damping().mass * dt / 2,
                                   .acceleration = of_dof,
                                   .first = now.step == 0});
}

/// Sets the contact of crack faces, and the strain energy where forces are not linear in the state: half their work is
/// another number there.
void complete(const DynamicOptions& options, const ContactAndDamping& contact_and_damping, Instant& instant) {
  if (const auto& faces = contact_and_damping.faces(); faces.any()) {
    instant.faces = &faces.contacts(), instant.contact_so_far = faces.so_far();
    instant.dissipated += instant.contact_so_far.lost;
  }
  if (!options.strain_energy) return;
  instant.strain_energy = options.strain_energy(instant.state);
  if (const auto& contact = contact_and_damping.contact()) instant.strain_energy += contact->spring();
}

/// Ranks of a distributed plate stop together, at a row.
bool stops_at(const Constraints& constraints, bool row) {
  if (!constraints.distributed()) return stop_is_asked();
  return row && largest_of(constraints, stop_is_asked()) > 0;
}

/// State in which a motion begins, or continues.
struct Begin {
  State state, velocity;  // velocity: half a step before, at step 0 that of time 0
  std::size_t step = 0;

  Begin(const DynamicOptions& options, Masses& masses, Eigen::Index points)
      : state(zero_state(points)), velocity(zero_state(points)) {
    if (const auto* from = options.from) {
      state = from->state, velocity = from->velocity, step = from->step;
      masses.restore(*from);
      return;
    }
    if (options.velocity.size() > 0)  // of what is held nobody asks before it follows
      masses.for_each(points, [&](const PointClass& one, std::size_t c, Eigen::Index first, std::uint32_t length) {
        if (one.mass[c] > 0) std::copy_n(options.velocity.data() + first, length, velocity.data() + first);
      });
    if (options.start.size() > 0) state = options.start;
    if (options.start.size() > 0) options.bent ? masses.bent(state) : masses.start(state);
    masses.give(options.given);
  }
};

/// Advances the motion by a step.
template <typename Real>
void move(const Step& now, const Values<Real>& force, const Masses& masses,
          const ContactAndDamping& contact_and_damping) {
  const double dt = now.time_step, share = now.step == 0 ? dt / 2 : dt;
  if (contact_and_damping.acts()) {
    const auto acceleration = acceleration_of(force, now.velocity, contact_and_damping, dt);
    masses.for_each(now.state.cols(),
                    [&](const PointClass& one, std::size_t c, Eigen::Index first, std::uint32_t length) {
                      for (Eigen::Index i = first; i < first + length; ++i) {
                        now.velocity.data()[i] += share * acceleration(one, c, i);
                        now.state.data()[i] += dt * now.velocity.data()[i];
                      }
                    });
    return;
  }
  masses.for_each(now.state.cols(),
                  [&](const PointClass& one, std::size_t c, Eigen::Index first, std::uint32_t length) {
                    const double per_force = share * one.inverse_mass[c], load = one.load[c];
                    double* const v = now.velocity.data() + first;
                    double* const u = now.state.data() + first;
                    const Real* const f = force.data() + first;
#pragma omp simd
                    for (std::uint32_t i = 0; i < length; ++i) {
                      v[i] += per_force * (double(f[i]) + load);
                      u[i] += dt * v[i];
                    }
                  });
}

/// Internal forces of a step and those beside them, not folded; on what is held, where that is wanted. `rest`: of the
/// state, where that may be on its way.
template <typename Real, typename InternalForce>
std::optional<Eigen::VectorXd> find_forces(const InternalForce& internal_force, const Constraints& constraints,
                                           const DrivenSupports& driven, const Step& now, PendingExchange* rest,
                                           bool on_held, Values<Real>& force, ContactAndDamping& contact_and_damping) {
  internal_force(now.state, rest, force);
  std::optional<Eigen::VectorXd> held;
  if (on_held) held = constraints.on_held(force);
  if constexpr (std::is_same_v<Real, double>) {
    const auto force_of = [&](State of) {
      PendingExchange rest_of(constraints, of);
      if (driven.any() && now.step > 0)  // the state of the step before
        rest_of.complete(), driven.place(of, double(now.step - 1) * now.time_step);
      Forces result;
      internal_force(of, &rest_of, result);
      return result;
    };
    if (contact_and_damping.acts()) contact_and_damping.find(now.state, now.velocity, force, force_of);
    if (held) contact_and_damping.add_on_held(constraints, force_of, *held);
  }
  return held;
}

/// State on which loads that move do work: without where supports are, which those account for. Nothing where it is the
/// state.
std::optional<State> state_that_loads_move(const State& state, const DrivenSupports& driven,
                                           const TravellingLoads& travelling) {
  if (!driven.any() || !travelling.any()) return std::nullopt;
  State result = state;
  driven.leave_out(result);
  return result;
}

/// Starts supports and loads that move from an equilibrium.
void start_from_rest(const State& state, DrivenSupports& driven, TravellingLoads& travelling) {
  driven.start();
  const auto free = state_that_loads_move(state, driven, travelling);
  travelling.start(free ? *free : state);
}

/// `internal_force(state, what it awaits or nothing, force)` in the number Real.
template <typename Real, typename InternalForce>
void steps(const InternalForce& internal_force, const Constraints& constraints, Masses masses, DrivenSupports driven,
           TravellingLoads travelling, Eigen::Index points, const DynamicOptions& options,
           const std::function<void(const Instant&)>& observe) {
  const double dt = options.time_step;
  auto [state, velocity, begin] = Begin(options, masses, points);
  ContactAndDamping contact_and_damping(options, state);
  if (const auto* from = options.from) {
    driven.restore(from->driven), travelling.restore(from->travelling);
    if (constraints.distributed() && driven.any()) constraints.impose(state), driven.place(state, double(begin) * dt);
  }
  if (!options.from && options.start.size() > 0 && !options.bent) start_from_rest(state, driven, travelling);
  Values<Real> force;
  std::optional<PendingExchange> rest;  // of the state
  for (std::size_t step = begin;; ++step) {
    const bool last = step == options.steps, row = last || step % options.observe_every == 0;  // longer ones go on
    if (rest && (row || options.changes)) rest->complete();
    const bool stops = stops_at(constraints, row), observed = row || stops;
    if (options.save && (stops || last || ((row || !constraints.distributed()) && options.due()))) {
      MotionCheckpoint memory{step, state, velocity, {}, {}, {}};
      masses.save(memory), contact_and_damping.save(memory);
      memory.driven = driven.memory(), memory.travelling = travelling.memory();
      options.save(memory);
    }
    const double time = static_cast<double>(step) * dt;
    const Step now{step, time, dt, state, velocity};
    if (options.changes) options.changes->before_force(now);
    driven.at(time, dt, step == 0);
    auto held_force = find_forces(internal_force, constraints, driven, now, rest ? &*rest : nullptr,
                                  observed && options.held_forces, force, contact_and_damping);
    driven.take(force, contact_and_damping);
    std::optional<Values<Real>> own;  // of the plate alone
    if (options.changes && travelling.any()) constraints.fold(own.emplace(force));
    const auto free = state_that_loads_move(state, driven, travelling);
    travelling.add(time, dt, free ? *free : state, force);
    constraints.fold(force), contact_and_damping.fold(constraints);
    if constexpr (std::is_same_v<Real, double>)
      if (options.changes) options.changes->after_force(now, own ? *own : force);
    if (masses.varies()) masses.at(time);
    press_faces(now, force, masses, contact_and_damping);
    const double work = observed || masses.varies() ? masses.work(time, state) : 0;
    driven.add_work(now, force, contact_and_damping);
    const auto [before, after] =
        contact_and_damping.damps() ? losses(now, force, masses, contact_and_damping) : std::array<double, 2>{0, 0};
    if (observed) {
      require_finite(state, fmt::format("at step {}, time {:g}", step, time), constraints);
      auto instant = seen(now, force, work, masses, constraints, contact_and_damping);
      instant.dissipated = contact_and_damping.dissipated() + before;
      driven.complete(instant), travelling.complete(instant), complete(options, contact_and_damping, instant);
      instant.held_force = std::move(held_force), instant.interrupted = stops;
      observe(instant);
    }
    if (last) return;
    if (stops) throw Interrupted(fmt::format("asked to stop at step {}, time {:g}", step, time));
    move(now, force, masses, contact_and_damping);
    contact_and_damping.lose(before + after), contact_and_damping.move(step == 0 ? dt / 2 : dt);
    rest.emplace(constraints, state);
    if (driven.any()) rest->complete(), driven.place_next(state);
  }
}

}  // namespace

void central_differences(const Operator& plate, const Constraints& constraints, Forces mass,
                         const std::vector<TimedLoad>& loads, const DynamicOptions& options,
                         const std::function<void(const Instant&)>& observe) {
  Masses masses(mass, loads, constraints);
  DrivenSupports driven;
  if (options.unconstrained_mass.cols() > 0)
    driven = {loads, constraints, options.unconstrained_mass, mass, options.own};
  const auto points = mass.cols();
  mass.resize(unknowns_per_point, 0);
  if (!options.single) {
    const auto internal_force = [&](const State& state, PendingExchange* rest, Forces& force) {
      rest ? plate.internal_force_overlapped(state, *rest, force) : plate.internal_force(state, force);
    };
    return steps<double>(internal_force, constraints, std::move(masses), std::move(driven),
                         TravellingLoads(loads, constraints), points, options, observe);
  }
  Values<float> rounded(unknowns_per_point, points);
  const auto internal_force = [&](const State& state, PendingExchange* rest, Values<float>& force) {
    if (rest) rest->complete();
#pragma omp parallel for simd schedule(static)
    for (Eigen::Index i = 0; i < state.size(); ++i) rounded.data()[i] = float(state.data()[i]);
    options.single(rounded, force);
  };
  steps<float>(internal_force, constraints, std::move(masses), std::move(driven), TravellingLoads(loads, constraints),
               points, options, observe);
}

namespace {

Forces inverse_of(const Forces& mass) {
  return mass.unaryExpr([](double m) { return m > 0 ? 1 / m : 0.0; });
}

Forces root_of(const Forces& values) {
  return values.unaryExpr([](double value) { return std::sqrt(value); });
}

double dot(const Constraints& constraints, const Forces& a, const State& b) {
  return ordered_sum<1>(constraints, static_cast<std::size_t>(a.size()),
                        [&](std::size_t i) { return std::array<double, 1>{a.data()[i] * b.data()[i]}; })[0];
}

/// max over i of (|K| s)_i / (M_i s_i) for a positive s bounds the eigenvalues of M^-1 K. From s = M^(-1/2), scaled
/// Gershgorin, improved by a few products.
double collatz_bound(const Operator& plate, const Constraints& constraints, const Forces& mass) {
  constexpr int improvements = 3;
  const Forces inverse_mass = inverse_of(mass);
  State scale = root_of(inverse_mass);
  Forces product;
  double smallest_bound = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= improvements; ++i) {
    constraints.impose_absolute(scale);
    plate.absolute_product(scale, product);
    constraints.fold_absolute(product);
    const State next = product.cwiseProduct(inverse_mass);
    double bound = 0, largest = 0;
    for (Eigen::Index n = 0; n < next.size(); ++n)
      if (mass.data()[n] > 0) {
        bound = std::max(bound, next.data()[n] / scale.data()[n]);
        largest = std::max(largest, next.data()[n] * std::sqrt(mass.data()[n]));
      }
    smallest_bound = std::min(smallest_bound, largest_of(constraints, bound));
    scale = next / largest_of(constraints, largest);
  }
  return smallest_bound;
}

/// The largest eigenvalue of M^-1 K and a margin, by Lanczos's recursion without a basis: lost orthogonality repeats
/// eigenvalues, but does not make the largest larger. Nothing where it does not settle.
std::optional<double> lanczos_bound(const Operator& plate, const Constraints& constraints, const Forces& mass,
                                    State now) {
  constexpr double tolerance = 1e-3, margin = 0.01;
  constexpr std::size_t most = 400, check_every = 10;
  const Forces root = root_of(inverse_of(mass));
  now = (root.array() > 0).select(now, 0.0);
  State before = zero_like(now);
  now /= std::sqrt(dot(constraints, now, now));
  std::vector<double> alpha, beta;
  Forces forces;
  State scaled;
  while (alpha.size() < most) {
    scaled = root.cwiseProduct(now);
    constraints.impose(scaled);
    plate.internal_force(scaled, forces);
    constraints.fold(forces);
    State next = -root.cwiseProduct(forces);  // M^(-1/2) K M^(-1/2) now
    if (!beta.empty()) next -= beta.back() * before;
    alpha.push_back(dot(constraints, next, now));
    next -= alpha.back() * now;
    beta.push_back(std::sqrt(dot(constraints, next, next)));
    if (alpha.size() % check_every == 0) {
      const auto size = Eigen::Index(alpha.size());
      const Eigenpairs ritz = tridiagonal_eigenpairs(Eigen::Map<Eigen::VectorXd>(alpha.data(), size),
                                                     Eigen::Map<Eigen::VectorXd>(beta.data(), size - 1));
      const double largest = ritz.values[size - 1];
      if (beta.back() * std::abs(ritz.vectors(size - 1, size - 1)) < tolerance * largest) return largest * (1 + margin);
    }
    if (!(beta.back() > 0)) return std::nullopt;  // a plate so small that the space is exhausted
    before = std::move(now);
    now = next / beta.back();
  }
  return std::nullopt;
}

}  // namespace

double stable_time_step(const Operator& plate, const Constraints& constraints, const Forces& mass,
                        std::optional<State> start) {
  if (!start) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    start = mass.unaryExpr([&](double m) { return m > 0 ? uniform(random) : 0.0; });
  }
  const double bound = collatz_bound(plate, constraints, mass);
  return 2 / std::sqrt(std::min(bound, lanczos_bound(plate, constraints, mass, std::move(*start)).value_or(bound)));
}

std::optional<State> start_by_place(const Formulation& plate) {
  if (!plate.distributed()) return std::nullopt;
  State start(unknowns_per_point, Eigen::Index(plate.points()));
  for (Eigen::Index k = 0; k < start.cols(); ++k) {
    const auto [column, row] = geometry::cell_of(plate.boundary().lattice[std::size_t(k)]);
    std::seed_seq seed{std::uint32_t(column), std::uint32_t(row)};
    std::array<std::uint32_t, unknowns_per_point> random{};
    seed.generate(random.begin(), random.end());
    for (Eigen::Index c = 0; c < unknowns_per_point; ++c)
      start(c, k) = std::ldexp(double(random[std::size_t(c)]), -31) - 1;
  }
  return start;
}

double stable_time_step(const Formulation& plate, double rotary) {
  if (const auto& elastic_supports = plate.boundary().elastic_supports; elastic_supports.unilateral())
    return stable_time_step(PlateInContact(plate, elastic_supports, everywhere(elastic_supports)), plate.constraints(),
                            plate.mass(rotary), start_by_place(plate));
  return stable_time_step(plate, plate.constraints(), plate.mass(rotary), start_by_place(plate));
}

}  // namespace plate
