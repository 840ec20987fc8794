#include "post/report/peaks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace post {
namespace {

/// Of one quantity of one tip.
using Key = std::pair<std::size_t, std::size_t>;  // tip, 0 to 2 of K1 to K3

void look(std::map<Key, Peak>& found, const Srif& srif, double time) {
  static const std::array names{"K1", "K2", "K3"};
  const std::array values{srif.K1, srif.K2, srif.K3};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!srif.resolved[i]) continue;
    auto& peak = found.try_emplace({srif.tip, i}, Peak{names[i], srif.tip, 0, time}).first->second;
    if (std::abs(values[i]) > std::abs(peak.value)) peak.value = values[i], peak.time = time;
  }
}

}  // namespace

std::vector<Peak> peaks(const std::vector<double>& times, const std::vector<std::vector<Srif>>& rows,
                        const Table& history) {
  std::map<Key, Peak> found;
  for (std::size_t n = 0; n < std::min(times.size(), rows.size()); ++n)
    for (std::size_t i = 0; i < rows[n].size(); ++i)
      if (i == 0 || rows[n][i - 1].tip != rows[n][i].tip) look(found, rows[n][i], times[n]);
  std::vector<Peak> result;
  for (auto& [key, peak] : found) result.push_back(std::move(peak));
  const auto time = history.column("time"), w = history.column("max_abs_w");
  Peak deflection{"w", std::nullopt, 0, 0};
  for (const auto& row : history.rows)
    if (const double value = std::get<double>(row[w]); value > deflection.value)
      deflection.value = value, deflection.time = std::get<double>(row[time]);
  result.push_back(std::move(deflection));
  return result;
}

std::vector<std::string> distrust_of_deflection(const Table& history, double thickness) {
  constexpr double small =
      0.5;  // thicknesses: a clamped circular plate is 12 % stiffer there (Timoshenko: w + 0.488 w^3)
  double largest = 0;
  for (const auto& row : history.rows) largest = std::max(largest, std::get<double>(row[history.column("max_abs_w")]));
  if (largest <= small * thickness) return {};
  return {
      fmt::format("the largest deflection, {:.3g}, is {:.2g} thicknesses: small deflections are left, a real plate "
                  "stretches and bends less; look at units and loads if this is a surprise",
                  largest, largest / thickness)};
}

}  // namespace post
