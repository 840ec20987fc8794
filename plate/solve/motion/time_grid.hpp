#pragma once
#include <array>
#include <cstddef>
#include <optional>

#include "plate/model/numerical_method.hpp"

namespace plate {

struct Analysis;

/// Damping with these ratios alpha / 2 omega + beta omega / 2 of the critical damping at these two frequencies
/// [1/time]. One of alpha and beta is negative where the ratios differ more than the frequencies allow.
Damping damping_of(const std::array<double, 2>& ratios, const std::array<double, 2>& frequencies);

/// The steps of a motion.
struct TimeGrid {
  double time_step;
  std::size_t steps, steps_per_row;  // rows of history, probes and intensity factors
  double relaxation = 0;             // DampedStep
};

/// Options of a time grid.
struct GridOptions {
  const Analysis& analysis;
  std::optional<double> row;  // time between rows; absent: duration / 400
  double most = 1;            // share of the stable step that may be used
};

/// Time between rows. Throws Refused where there are too many.
double row_of(const GridOptions& options);

/// Steps that end exactly on the rows of history, none above `limit`. Throws Refused where more is asked for.
TimeGrid time_grid(const GridOptions& options, double limit);

/// Grid with one step per row, for motions that need no steps. Throws Refused where there are too many.
TimeGrid row_grid(const GridOptions& options);

/// The stable step of central differences whose stiffness damps with the velocity half a step before, of a plate whose
/// own is `undamped`: omega^2 (dt^2 + 2 beta dt) = 4 (theory (84)). With alpha dt at most 0.1: the first half step
/// of a plate that begins with a velocity takes (alpha dt / 2)^2 of its energy without booking it.
double stable_step(double undamped, const Damping& damping);

/// Stable step of a damped motion [time], and the time in which the force of stiffness-proportional damping relaxes; 0:
/// it follows the velocity.
struct DampedStep {
  double limit, relaxation = 0;
};

/// Half of the undamped step or more: where stable_step() is shorter, the force relaxes in beta / 3 (theory (84a)). Not
/// where a period of exact_below() is longer than the duration.
DampedStep damped_step(double undamped, const Damping& damping, double duration);
/// Frequency below which damping that relaxes has the ratios, and modes their frequencies, to 1 % [1/time].
double exact_below(const Damping& damping);

}  // namespace plate
