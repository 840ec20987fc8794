#include "plate/model/history.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plate {
namespace {

double interpolate(const std::vector<std::pair<double, double>>& table, double time) {
  const auto after =
      std::upper_bound(table.begin(), table.end(), time, [](double t, const auto& entry) { return t < entry.first; });
  if (after == table.begin()) return table.front().second;
  if (after == table.end()) return table.back().second;
  const auto before = after - 1;
  const double share = (time - before->first) / (after->first - before->first);
  return before->second + share * (after->second - before->second);
}

}  // namespace

double factor(const History& history, double time) {
  switch (history.kind) {
    case History::Kind::step:
      return 1;
    case History::Kind::ramp:
      return std::min(1.0, time / history.rise_time);
    case History::Kind::sine:
      return std::sin(2 * std::numbers::pi * history.frequency * time);
    case History::Kind::table:
      return interpolate(history.table, time);
  }
  return 1;
}

}  // namespace plate
