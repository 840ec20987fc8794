#include "post/report/curves.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "post/factors/srif.hpp"
#include "post/files/table.hpp"
#include "post/report/curve_plot.hpp"

namespace post {
namespace {

constexpr double gap = std::numeric_limits<double>::quiet_NaN();

std::string with_unit(const std::string& words, bool si, const std::string& unit) {
  return si ? fmt::format("{} [{}]", words, unit) : words;
}

std::vector<double> numbers(const Table& table, const std::string& column) {
  const auto at = table.column(column);
  std::vector<double> result;
  for (const auto& row : table.rows) {
    const auto* number = std::get_if<double>(&row[at]);
    result.push_back(number ? *number : gap);
  }
  return result;
}

double largest(const std::vector<double>& values) {
  double result = 0;
  for (const double value : values)
    if (std::isfinite(value)) result = std::max(result, std::abs(value));
  return result;
}

/// Series of K1, K2 or K3 of all tips.
std::vector<Series> factors(const std::vector<double>& times, const std::vector<std::vector<Srif>>& rows,
                            std::size_t which) {
  double least = 0;  // what is less is the noise of a symmetric plate
  for (const auto& row : rows)
    for (const auto& srif : row) least = std::max({least, 1e-6 * std::abs(srif.K1), 1e-6 * std::abs(srif.K2)});
  std::map<std::size_t, Curve> found;  // tip
  for (std::size_t n = 0; n < std::min(times.size(), rows.size()); ++n)
    for (const auto* srif : recommended(rows[n])) {
      const std::array values{srif->K1, srif->K2, srif->K3};
      auto& curve = found[srif->tip];
      curve.t.push_back(times[n]), curve.y.push_back(srif->resolved[which] ? values[which] : gap);
    }
  std::vector<Series> series;
  for (auto& [tip, curve] : found)
    if (largest(curve.y) > least) series.push_back({fmt::format("tip {}", tip), Line::plain, std::move(curve), tip});
  return series;
}

void add(CurvePlot& plot, const std::string& t, const std::string& y, std::vector<Series> series) {
  if (!series.empty()) plot.panels.push_back({t, y, std::move(series)});
}

/// Series of the columns that have a value other than zero.
std::vector<Series> lines(const Table& table, const std::vector<double>& t,
                          const std::vector<std::pair<std::string, std::string>>& columns) {
  std::vector<Series> series;
  for (const auto& [column, label] : columns)
    if (auto values = numbers(table, column); largest(values) > 0)
      series.push_back({label, Line::plain, {t, std::move(values)}, series.size()});
  return series;
}

}  // namespace

CurvePlot curves_of_motion(const std::string& title, const std::vector<double>& times,
                           const std::vector<std::vector<Srif>>& rows, const Table& history, bool si) {
  constexpr std::array names{"K1", "K2", "K3"}, units{"N m^1/2", "N m^1/2", "N m^-1/2"};
  CurvePlot plot{title, {}};
  const auto time = with_unit("time", si, "s");
  for (std::size_t i = 0; i < 3; ++i) add(plot, time, with_unit(names[i], si, units[i]), factors(times, rows, i));
  const auto t = numbers(history, "time");
  add(plot, time, with_unit("largest |w|", si, "m"), lines(history, t, {{"max_abs_w", ""}}));
  add(plot, time, with_unit("energy", si, "J"),
      lines(history, t,
            {{"external_work", "work of the loads"},
             {"strain_energy", "strain energy"},
             {"kinetic_energy", "kinetic energy"},
             {"fracture_energy", "fracture energy"}}));
  return plot;
}

CurvePlot curves_of_growth(const std::string& title, const Table& growth, bool si) {
  CurvePlot plot{title, {}};
  const auto length = numbers(growth, "crack_length");
  const auto axis = with_unit("length of the cracks", si, "m");
  add(plot, axis, "load factor", lines(growth, length, {{"load_factor", ""}}));
  add(plot, axis, with_unit("energy", si, "J"),
      lines(growth, length,
            {{"external_work", "work of the loads"},
             {"strain_energy", "strain energy"},
             {"fracture_energy", "fracture energy"}}));
  return plot;
}

CurvePlot curves_of_path(const std::string& title, const Table& steps, bool si) {
  CurvePlot plot{title, {}};
  const auto axis = with_unit("w of the point that deflects most at first", si, "m");
  const auto deflection = numbers(steps, "deflection");
  add(plot, axis, "load factor", lines(steps, deflection, {{"factor", ""}}));
  add(plot, axis, with_unit("strain energy", si, "J"), lines(steps, deflection, {{"strain_energy", ""}}));
  return plot;
}

std::string picture_of_growth(const std::string& title, const Table& growth, bool si) {
  return to_svg(curves_of_growth(title, growth, si));
}

}  // namespace post
