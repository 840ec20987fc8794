#pragma once
#include <utility>
#include <vector>

namespace plate {

/// Variation of a load in time, as a factor of its value.
struct History {
  enum class Kind { step, ramp, sine, table, constant };  // constant: in full while other loads grow, at rest
  Kind kind = Kind::step;
  double rise_time = 0;                          // ramp: linear from 0 to 1 over this time, then 1
  double frequency = 0;                          // sine: sin(2 pi f t)
  std::vector<std::pair<double, double>> table;  // table: (time, factor), times ascending; constant beyond its ends

  bool constant() const { return kind == Kind::step; }
  bool operator==(const History&) const = default;
};

/// The factor at time t >= 0; a step is 1 from t = 0 on.
double factor(const History& history, double time);

}  // namespace plate
