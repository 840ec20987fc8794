#pragma once
#include <array>
#include <memory>
#include <vector>

#include "plate/model/history.hpp"
#include "plate/model/loading/moving_forces.hpp"

namespace plate {

struct Instant;
struct TimedLoad;

/// The loads of a motion by steps that move along paths: what they add to the forces, and their work by the trapezoidal
/// rule. Without such loads it holds nothing and does nothing.
class TravellingLoads {
public:
  TravellingLoads() = default;
  explicit TravellingLoads(const std::vector<TimedLoad>& loads);

  bool any() const { return !loads_.empty(); }

  /// Books the work up to now and adds the forces of now to the internal ones, before they are carried over. The time
  /// is a whole number of steps.
  template <typename Real>
  void add(double time, double time_step, const State& state, Values<Real>& force);
  /// What energies, work and potential leave out, or have too much of as these are no internal forces.
  void complete(Instant& seen) const;

  /// The numbers to go on from.
  std::vector<double> memory() const;
  void recall(const std::vector<double>& memory);

private:
  struct Travelling {
    std::shared_ptr<const MovingForces> forces;
    History history;
  };
  /// Of the forces of some times with the state, over all own points.
  template <std::size_t N>
  std::array<double, N> products(const std::array<double, N>& times, const State& state) const;

  std::vector<Travelling> loads_;
  double work_ = 0, now_ = 0, next_ = 0;  // next: of the forces of the step after with the state of now
  bool begun_ = false;
};

}  // namespace plate
