#include "plate/solve/motion/time_grid.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "plate/model/errors.hpp"
#include "plate/solve/analysis.hpp"

namespace plate {

Damping damping_of(const std::array<double, 2>& ratios, const std::array<double, 2>& frequencies) {
  const double a = 2 * std::numbers::pi * frequencies[0], b = 2 * std::numbers::pi * frequencies[1];
  const double squares = b * b - a * a;
  return {2 * a * b * (ratios[0] * b - ratios[1] * a) / squares, 2 * (ratios[1] * b - ratios[0] * a) / squares};
}

namespace {

constexpr double most_steps = 1e12;  // twelve days at a microsecond each; integers are exact up to 9e15
constexpr double most_rows = 1e7;    // kept in memory until they are written: some gigabytes

[[noreturn]] void refuse(Subject subject, const std::string& what) {
  throw Refused({{subject, 0, what}});
}

void check_count(double duration, Subject subject, double time_step) {
  const double steps = duration / time_step;
  if (!(time_step >= std::numeric_limits<double>::min()) || !(steps <= most_steps))
    refuse(subject, fmt::format("a duration of {:g} in steps of {:g} is {:g} steps: between 1 and {:g} can be counted",
                                duration, time_step, steps, most_steps));
}

TimeGrid given_steps(const GridOptions& options, double limit, double row) {
  const double dt = *options.analysis.time_step, share = options.most;
  if (dt > share * limit)
    refuse(Subject::time_step,
           share < 1
               ? fmt::format(
                     "{:g} is above {:.6g}, {:g} of the stable limit {:.6g} of this plate: growth can make it stiffer",
                     dt, share * limit, share, limit)
               : fmt::format("{:g} is above the stable limit {:.6g} of this plate", dt, limit));
  check_count(options.analysis.duration, Subject::time_step, dt);
  return {dt, static_cast<std::size_t>(std::ceil(options.analysis.duration / dt - 1e-9)),
          static_cast<std::size_t>(std::clamp(std::round(row / dt), 1.0, most_steps))};
}

}  // namespace

double row_of(const GridOptions& options) {
  const double duration = options.analysis.duration, row = options.row.value_or(duration / 400);
  if (!(duration / row <= most_rows))
    refuse(options.row ? Subject::rows : Subject::duration,
           fmt::format("a duration of {:g} in rows of {:g} is {:g} rows: at most {:g} can be kept", duration, row,
                       duration / row, most_rows));
  return row;
}

TimeGrid row_grid(const GridOptions& options) {
  constexpr double rounding = 1e-12;
  const double duration = options.analysis.duration, row = row_of(options);
  const double rows = std::max(1.0, std::round(duration / row)), between = duration / rows;
  // the same number for all durations of whole rows
  return {std::abs(between - row) <= rounding * row ? row : between, static_cast<std::size_t>(rows), 1};
}

TimeGrid time_grid(const GridOptions& options, double limit) {
  const double duration = options.analysis.duration;
  if (!(limit > 0) || !std::isfinite(limit))
    refuse(Subject::density,
           fmt::format(
               "the stable time step comes out as {:g}: density, stiffness and lengths are beyond what numbers hold; "
               "choose other units",
               limit));
  const double row = row_of(options);
  if (options.analysis.time_step) return given_steps(options, limit, row);
  // whole steps between rows, whole rows in the duration
  const auto rows = row_grid(options);
  const double between = rows.time_step;
  const double steps = std::max(1.0, std::ceil(between / (std::min(options.analysis.safety, options.most) * limit)));
  check_count(duration, Subject::duration, between / steps);
  return {between / steps, static_cast<std::size_t>(double(rows.steps) * steps), static_cast<std::size_t>(steps)};
}

double stable_step(double undamped, const Damping& damping) {
  const double beta = damping.stiffness, stable = undamped * undamped / (std::hypot(beta, undamped) + beta);
  return damping.mass > 0 ? std::min(stable, 0.1 / damping.mass) : stable;
}

DampedStep damped_step(double undamped, const Damping& damping, double duration) {
  constexpr double shrinks = 2;
  const double exact = stable_step(undamped, damping), shortest = undamped / shrinks;
  if (stable_step(undamped, {0, damping.stiffness}) >= shortest) return {exact};
  if (exact_below(damping) * duration < 1) return {exact};
  const double limit = damping.mass > 0 ? std::min(shortest, 0.1 / damping.mass) : shortest;
  if (limit <= exact) return {exact};
  return {limit, damping.stiffness / (shrinks * shrinks - 1)};
}

double exact_below(const Damping& damping) {
  constexpr double ratio = 0.12;  // by the stiffness: frequencies 2/3 of its square too high
  return ratio / (std::numbers::pi * damping.stiffness);
}

}  // namespace plate
