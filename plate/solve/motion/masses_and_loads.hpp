#pragma once
#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "plate/formulation/constraints.hpp"
#include "plate/model/history.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"
#include "plate/solve/motion/dynamics.hpp"

namespace plate {

using ByComponent = std::array<double, unknowns_per_point>;  // values of a point

/// Mass and loads of a point; lattices have few different ones.
struct PointClass {
  ByComponent mass, inverse_mass, load;  // load: the sum at the time in hand
  std::vector<ByComponent> loads;        // of every load, at factor 1
};

/// Points that follow each other in one class.
struct Run {
  std::uint32_t first, length, point_class;
};

/// Mass and loads of all points, and what they do: a table in place of arrays by point. Points without either, as those
/// of other processes, are left out: they stay where they are.
class Masses {
public:
  /// `constraints` must outlive this.
  Masses(const Forces& mass, std::vector<TimedLoad> loads, const Constraints& constraints);

  bool varies() const { return varies_; }

  /// Sets the sums of the loads.
  void at(double time);

  /// Mass and loads of a point that has some.
  const PointClass& at_point(std::uint32_t point) const {
    const auto after = std::ranges::upper_bound(runs_, point, {}, &Run::first);
    return classes_[std::prev(after)->point_class];
  }

  /// visit(class, component, index of the first value, number of values) for all points, from several threads.
  template <typename Visit>
  void for_each(Eigen::Index points, const Visit& visit) const {
#pragma omp parallel for schedule(static)
    for (std::size_t r = 0; r < runs_.size(); ++r)
      for (std::size_t c = 0; c < unknowns_per_point; ++c)
        visit(classes_[runs_[r].point_class], c, Eigen::Index(c) * points + runs_[r].first, runs_[r].length);
  }

  /// Sums of term(class, component, index) -> std::array<double, N>, in one order for any number of threads.
  template <std::size_t N, typename Term>
  std::array<double, N> sum(Eigen::Index points, const Term& term) const {
    const auto visit = [&](std::size_t r, const auto& add) {
      for (std::size_t c = 0; c < unknowns_per_point; ++c) {
        const auto& one = classes_[runs_[r].point_class];
        const Eigen::Index begin = Eigen::Index(c) * points + runs_[r].first;
        for (Eigen::Index i = begin; i < begin + runs_[r].length; ++i) add(term(one, c, i));
      }
    };
    if (constraints_->distributed())
      return exact_sum<N>(*constraints_, runs_.size(), [&](std::size_t r, const auto& add) {
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

  /// Starts from a state under loads that have grown slowly to what they are at time 0.
  void start(const State& state);
  /// Sets the state that something else than the loads has caused.
  void bent(const State& state);
  /// Adds the work [energy] by which something else than the loads has begun the motion.
  void give(double work) {
    given_ += work;
  }

  /// Work of the loads up to now, with what began the motion. A load that varies needs a call each step (trapezoidal
  /// rule), a constant one does not.
  double work(double time, const State& state);

  void save(MotionCheckpoint& memory) const {
    memory.loads = last_, memory.work = work_, memory.before = before_, memory.given = given_;
  }
  void restore(const MotionCheckpoint& memory) {
    last_ = memory.loads, work_ = memory.work, before_ = memory.before, given_ = memory.given;
  }

private:
  const Constraints* constraints_;
  std::vector<PointClass> classes_;
  std::vector<Run> runs_;
  std::vector<History> histories_;
  std::vector<std::pair<double, double>> last_;  // F . u and factor of the call before
  std::vector<double> work_, before_;            // before: of constant loads, less than their work at once
  double given_ = 0;                             // by what began the motion [energy]
  bool varies_ = false;
};

/// The loads of a motion by steps that move along paths: what they add to the forces, and their work by the trapezoidal
/// rule. Without such loads it holds nothing and does nothing.
class TravellingLoads {
public:
  TravellingLoads() = default;
  /// `constraints` must outlive this.
  TravellingLoads(const std::vector<TimedLoad>& loads, const Constraints& constraints);

  bool any() const { return !loads_.empty(); }

  /// Starts from a state under loads that have grown slowly to what they are at time 0.
  void start(const State& state);
  /// Counts the work up to now and adds the forces of now to the internal ones, before they are carried over. The time
  /// is a whole number of steps.
  template <typename Real>
  void add(double time, double time_step, const State& state, Values<Real>& force);
  /// Corrects energies, work and potential for these loads: adds what they leave out, and subtracts what they have too
  /// much of as these are no internal forces.
  void complete(Instant& seen) const;

  /// The numbers to go on from.
  std::vector<double> memory() const;
  void restore(const std::vector<double>& memory);

private:
  struct Travelling {
    std::shared_ptr<const MovingForces> forces;
    History history;
  };
  /// Scalar products of the forces at some times with the state, over all owned points.
  template <std::size_t N>
  std::array<double, N> products(const std::array<double, N>& times, const State& state) const;

  const Constraints* constraints_ = nullptr;
  std::vector<Travelling> loads_;
  double work_ = 0, now_ = 0, next_ = 0;  // next: of the forces of the step after with the state of now
  bool begun_ = false;
};

}  // namespace plate
