#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/driver/run.hpp"
#include "cases/input/case.hpp"
#include "cases/input/case_file.hpp"

namespace cases {
namespace {

constexpr double most_steps = 1e12;  // twelve days at a microsecond each; integers are exact up to 9e15
constexpr double most_rows = 1e7;    // kept in memory until they are written: some gigabytes

[[noreturn]] void refuse(const CaseFile& file, const char* key, const std::string& what) {
  throw CaseError({{file.place(key), key, what}});
}

/// Largest share of the stable step: edges that a crack leaves at an angle to the lattice are a little stiffer than
/// those of the start, families that bonds leave one by one by 1.3 at most (measured where a plate fell to pieces).
double largest_share(const Case& c) {
  if (!c.growth) return 1;
  return c.growth->by_bonds() ? 0.8 : 0.9;
}

void check_count(const CaseFile& file, const char* key, double time_step) {
  const double steps = file.content.analysis.duration / time_step;
  if (!(time_step >= std::numeric_limits<double>::min()) || !(steps <= most_steps))
    refuse(file, key,
           fmt::format("a duration of {:g} in steps of {:g} is {:g} steps: between 1 and {:g} can be counted",
                       file.content.analysis.duration, time_step, steps, most_steps));
}

TimeGrid given_steps(const CaseFile& file, double limit, double row) {
  const Case& c = file.content;
  const double dt = *c.analysis.time_step, share = largest_share(c);
  if (dt > share * limit)
    refuse(file, "analysis.time_step",
           share < 1
               ? fmt::format(
                     "{:g} is above {:.6g}, {:g} of the stable limit {:.6g} of this plate: growth can make it stiffer",
                     dt, share * limit, share, limit)
               : fmt::format("{:g} is above the stable limit {:.6g} of this plate", dt, limit));
  check_count(file, "analysis.time_step", dt);
  return {dt, static_cast<std::size_t>(std::ceil(c.analysis.duration / dt - 1e-9)),
          static_cast<std::size_t>(std::clamp(std::round(row / dt), 1.0, most_steps))};
}

}  // namespace

namespace {

/// Time between rows as the file asks for it.
double row_of(const CaseFile& file) {
  const Case& c = file.content;
  const double duration = c.analysis.duration, row = c.output.history_every.value_or(duration / 400);
  if (!(duration / row <= most_rows))
    refuse(file, c.output.history_every ? "output.history_every" : "analysis.duration",
           fmt::format("a duration of {:g} in rows of {:g} is {:g} rows: at most {:g} can be kept", duration, row,
                       duration / row, most_rows));
  return row;
}

}  // namespace

TimeGrid row_grid(const CaseFile& file) {
  const double duration = file.content.analysis.duration, rows = std::max(1.0, std::round(duration / row_of(file)));
  return {duration / rows, static_cast<std::size_t>(rows), 1};
}

TimeGrid time_grid(const CaseFile& file, double limit) {
  const Case& c = file.content;
  const double duration = c.analysis.duration;
  if (!(limit > 0) || !std::isfinite(limit))
    refuse(file, "section.density",
           fmt::format(
               "the stable time step comes out as {:g}: density, stiffness and lengths are beyond what numbers hold; "
               "choose other units",
               limit));
  const double row = row_of(file);
  if (c.analysis.time_step) return given_steps(file, limit, row);
  // whole steps between rows, whole rows in the duration
  const double rows = std::max(1.0, std::round(duration / row)), between = duration / rows;
  const double steps = std::max(1.0, std::ceil(between / (std::min(c.analysis.safety, largest_share(c)) * limit)));
  check_count(file, "analysis.duration", between / steps);
  return {between / steps, static_cast<std::size_t>(rows * steps), static_cast<std::size_t>(steps)};
}

}  // namespace cases
