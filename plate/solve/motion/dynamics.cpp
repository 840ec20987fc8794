#include "plate/solve/motion/dynamics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "plate/formulation/constraints.hpp"
#include "plate/model/history.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/solve/finite.hpp"
#include "plate/solve/interruption.hpp"
#include "plate/solve/motion/driven_supports.hpp"
#include "plate/solve/motion/travelling_loads.hpp"
#include "plate/solve/reduction.hpp"

namespace plate {
namespace {

using Triple = std::array<double, 3>;  // per component of a State

/// Mass and loads of a point; lattices have few different ones.
struct PointClass {
  Triple mass, inverse_mass, load;  // load: the sum at the time in hand
  std::vector<Triple> loads;        // of every load, at factor 1
};

/// Points that follow each other in one class.
struct Run {
  std::uint32_t first, length, point_class;
};

/// Mass and loads of all points, and what they do: a table in place of arrays by point. Points without either, as those
/// of other processes, are left out: they stay where they are.
class Masses {
public:
  Masses(const Forces& mass, std::vector<TimedLoad> loads, const Constraints& constraints) {
    constexpr std::uint32_t longest = 1024;  // runs are shared out among threads
    for (auto& load : loads) {
      constraints.fold(load.forces);
      histories_.push_back(load.history);
      varies_ = varies_ || !load.history.constant();
    }
    last_.assign(loads.size(), {0, 0});
    work_.assign(loads.size(), 0), before_.assign(loads.size(), 0);
    std::map<std::vector<double>, std::uint32_t> known;
    std::vector<double> key, before;
    for (Eigen::Index k = 0; k < mass.cols(); ++k) {
      key.assign(mass.col(k).begin(), mass.col(k).end());
      for (const auto& load : loads) key.insert(key.end(), load.forces.col(k).begin(), load.forces.col(k).end());
      if (std::ranges::all_of(key, [](double value) { return value == 0; })) {
        before.clear();
        continue;
      }
      if (key == before && runs_.back().length < longest) {
        ++runs_.back().length;
        continue;
      }
      const auto [entry, fresh] = known.try_emplace(key, std::uint32_t(known.size()));
      if (fresh) classes_.push_back(class_of(key));
      runs_.push_back({std::uint32_t(k), 1, entry->second});
      before = key;
    }
    at(0);
  }

  bool varies() const { return varies_; }

  void at(double time) {
    for (auto& one : classes_) {
      one.load = {0, 0, 0};
      for (std::size_t i = 0; i < histories_.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) one.load[c] += factor(histories_[i], time) * one.loads[i][c];
    }
  }

  /// visit(class, component, index of the first value, number of values) for all points, from several threads.
  template <typename Visit>
  void for_each(Eigen::Index points, const Visit& visit) const {
#pragma omp parallel for schedule(static)
    for (std::size_t r = 0; r < runs_.size(); ++r)
      for (std::size_t c = 0; c < 3; ++c)
        visit(classes_[runs_[r].point_class], c, Eigen::Index(c) * points + runs_[r].first, runs_[r].length);
  }

  /// Sums of term(class, component, index) -> std::array<double, N>, in one order for any number of threads.
  template <std::size_t N, typename Term>
  std::array<double, N> sum(Eigen::Index points, const Term& term) const {
    const auto visit = [&](std::size_t r, const auto& add) {
      for (std::size_t c = 0; c < 3; ++c) {
        const auto& one = classes_[runs_[r].point_class];
        const Eigen::Index begin = Eigen::Index(c) * points + runs_[r].first;
        for (Eigen::Index i = begin; i < begin + runs_[r].length; ++i) add(term(one, c, i));
      }
    };
    if (const Ranks* all = ranks())
      return exact_sum<N>(*all, runs_.size(), [&](std::size_t r, const auto& add) {
        visit(r, [&](const std::array<double, N>& value) {
          for (std::size_t n = 0; n < N; ++n) add(n, value[n]);
        });
      });
    std::vector<std::array<double, N>> partial(runs_.size());
#pragma omp parallel for schedule(static)
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      std::array<double, N> part{};
      visit(r, [&part](const std::array<double, N>& value) {
        for (std::size_t n = 0; n < N; ++n) part[n] += value[n];
      });
      partial[r] = part;
    }
    std::array<double, N> total{};
    for (const auto& part : partial)
      for (std::size_t n = 0; n < N; ++n) total[n] += part[n];
    return total;
  }

  /// Loads have grown slowly to what they are at time 0, where this is the state.
  void start(const State& state) {
    work(0, state);
    for (std::size_t l = 0; l < histories_.size(); ++l)
      if (histories_[l].constant()) before_[l] = -last_[l].first * last_[l].second / 2;
  }

  /// Work of the loads up to now. A load that varies needs a call each step (trapezoidal rule), a constant one does
  /// not.
  double work(double time, const State& state) {
    double all = 0;
    for (std::size_t l = 0; l < histories_.size(); ++l) {
      const auto [share] = sum<1>(state.cols(), [&](const PointClass& one, std::size_t c, Eigen::Index i) {
        return std::array<double, 1>{one.loads[l][c] * state.data()[i]};
      });
      const double now = factor(histories_[l], time);
      auto& [share_before, factor_before] = last_[l];
      work_[l] =
          histories_[l].constant() ? share + before_[l] : work_[l] + (now + factor_before) / 2 * (share - share_before);
      last_[l] = {share, now};
      all += work_[l];
    }
    return all;
  }

  void remember(MotionMemory& memory) const {
    memory.loads = last_, memory.work = work_, memory.before = before_;
  }
  void recall(const MotionMemory& memory) {
    last_ = memory.loads, work_ = memory.work, before_ = memory.before;
  }

private:
  /// `key`: mass, then every load.
  static PointClass class_of(const std::vector<double>& key) {
    PointClass result{};
    for (std::size_t c = 0; c < 3; ++c) {
      result.mass[c] = key[c];
      result.inverse_mass[c] = key[c] > 0 ? 1 / key[c] : 0;
    }
    for (std::size_t i = 3; i < key.size(); i += 3) result.loads.push_back({key[i], key[i + 1], key[i + 2]});
    return result;
  }

  std::vector<PointClass> classes_;
  std::vector<Run> runs_;
  std::vector<History> histories_;
  std::vector<std::pair<double, double>> last_;  // F . u and factor of the call before
  std::vector<double> work_, before_;            // before: of constant loads, less than their work at once
  bool varies_ = false;
};

/// What those who observe see of a step; all that is given must outlive it. `force`: folded.
template <typename Real>
Instant seen(const Step& now, const Values<Real>& force, double work, const Masses& masses,
             const Constraints& constraints) {
  const Eigen::Index points = now.state.cols();
  const double dt = now.time_step;
  // velocity at the full step: half a step on from the one before, none at the start
  const double half = now.step == 0 ? 0 : dt / 2;
  const auto acceleration = [&force](const PointClass& one, std::size_t c, Eigen::Index i) {
    return (double(force.data()[i]) + one.load[c]) * one.inverse_mass[c];
  };
  const auto [kinetic, product, potential,
              strain] = masses.sum<4>(points, [&](const PointClass& one, std::size_t c, Eigen::Index i) {
    const double a = acceleration(one, c, i), v = now.velocity.data()[i] + half * a, change = dt / 2 * a;
    return std::array<double, 4>{one.mass[c] * v * v / 2, one.mass[c] * (v * v - change * change) / 2,
                                 one.load[c] * now.state.data()[i], -double(force.data()[i]) * now.state.data()[i] / 2};
  });
  // `first` and `share` of the acceleration
  const auto combined = [&masses, &constraints, acceleration, points](State first, double share) {
    masses.for_each(points, [&](const PointClass& one, std::size_t c, Eigen::Index begin, std::uint32_t length) {
      for (Eigen::Index i = begin; i < begin + length; ++i) first.data()[i] += share * acceleration(one, c, i);
    });
    constraints.impose(first);
    return first;
  };
  return {now.step,   now.time,
          now.state,  [combined, &velocity = now.velocity, half] { return combined(velocity, half); },
          kinetic,    work,
          strain,     product,
          -potential, [combined, points] { return combined(State::Zero(3, points), 1); },
          {}};
}

/// Processes that share the plate stop together, at a row.
bool stops_at(bool row) {
  if (!ranks()) return stop_is_asked();
  return row && largest_of_all(stop_is_asked()) > 0;
}

/// `internal_force(state, force)` in the number Real.
template <typename Real, typename InternalForce>
void steps(const InternalForce& internal_force, const Constraints& constraints, Masses masses, DrivenSupports driven,
           TravellingLoads travelling, Eigen::Index points, const DynamicOptions& options,
           const std::function<void(const Instant&)>& observe) {
  const double dt = options.time_step;
  const auto* const from = options.from;
  State state = from ? from->state : options.start.size() > 0 ? options.start : State(State::Zero(3, points));
  State velocity = from ? from->velocity : State(State::Zero(3, points));  // at half steps
  if (from) masses.recall(*from), driven.recall(from->driven), travelling.recall(from->travelling);
  if (!from && options.start.size() > 0) masses.start(state), driven.start();
  Values<Real> force;
  for (std::size_t step = from ? from->step : 0;; ++step) {
    const bool row = step % options.observe_every == 0 || step == options.steps;
    const bool stops = stops_at(row);
    if (options.keep && (stops || ((row || !ranks()) && options.due()))) {
      MotionMemory memory{step, state, velocity, {}, {}, {}};
      masses.remember(memory), memory.driven = driven.memory(), memory.travelling = travelling.memory();
      options.keep(memory);
    }
    const double time = static_cast<double>(step) * dt;
    const Step now{step, time, dt, state, velocity};
    if (options.changes) options.changes->before_force(now);
    const bool observed = row || stops;
    driven.at(time, dt, step == 0);
    internal_force(state, force);
    std::optional<Eigen::VectorXd> held_force;
    if (observed && options.held_forces) held_force = constraints.on_held(force);
    driven.take(force), travelling.add(time, dt, state, force);
    constraints.fold(force);
    if constexpr (std::is_same_v<Real, double>)
      if (options.changes) options.changes->after_force(now, force);
    if (masses.varies()) masses.at(time);
    const double work = observed || masses.varies() ? masses.work(time, state) : 0;
    driven.book(state, velocity, force, step == 0 ? 0 : dt / 2);
    if (observed) {
      require_finite(state, fmt::format("at step {}, time {:g}", step, time));
      auto instant = seen(now, force, work, masses, constraints);
      driven.complete(instant), travelling.complete(instant);
      instant.held_force = std::move(held_force);
      instant.interrupted = stops;
      observe(instant);
    }
    if (step == options.steps) return;
    if (stops) throw Interrupted(fmt::format("asked to stop at step {}, time {:g}", step, time));
    const double share = step == 0 ? dt / 2 : dt;
    masses.for_each(points, [&](const PointClass& one, std::size_t c, Eigen::Index first, std::uint32_t length) {
      const double per_force = share * one.inverse_mass[c], load = one.load[c];
      double* const v = velocity.data() + first;
      double* const u = state.data() + first;
      const Real* const f = force.data() + first;
#pragma omp simd
      for (std::uint32_t i = 0; i < length; ++i) {
        v[i] += per_force * (double(f[i]) + load);
        u[i] += dt * v[i];
      }
    });
    constraints.impose(state);
    driven.place_next(state);
  }
}

}  // namespace

void central_differences(const Operator& plate, const Constraints& constraints, Forces mass,
                         const std::vector<TimedLoad>& loads, const DynamicOptions& options,
                         const std::function<void(const Instant&)>& observe) {
  Masses masses(mass, loads, constraints);
  DrivenSupports driven;
  if (options.whole_mass.cols() > 0) driven = {loads, constraints, options.whole_mass, mass};
  const auto points = mass.cols();
  mass.resize(3, 0);
  if (!options.single) {
    const auto internal_force = [&](const State& state, Forces& force) { plate.internal_force(state, force); };
    return steps<double>(internal_force, constraints, std::move(masses), std::move(driven), TravellingLoads(loads),
                         points, options, observe);
  }
  Values<float> rounded(3, points);
  const auto internal_force = [&](const State& state, Values<float>& force) {
#pragma omp parallel for simd schedule(static)
    for (Eigen::Index i = 0; i < state.size(); ++i) rounded.data()[i] = float(state.data()[i]);
    options.single(rounded, force);
  };
  steps<float>(internal_force, constraints, std::move(masses), std::move(driven), TravellingLoads(loads), points,
               options, observe);
}

}  // namespace plate
