#include "post/studies/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "post/files/table.hpp"
#include "post/studies/quantity.hpp"

namespace post {
namespace {

using Row = std::vector<Cell>;

std::optional<double> number(const Cell& cell) {
  const auto* value = std::get_if<double>(&cell);
  return value && std::isfinite(*value) ? std::optional(*value) : std::nullopt;
}

std::string word(const Cell& cell) {
  const auto* text = std::get_if<std::string>(&cell);
  return text ? *text : std::string();
}

bool has(const Table& table, const std::string& name) {
  return std::ranges::find(table.columns, name) != table.columns.end();
}

void check(const std::vector<double>& t, const std::vector<double>& y, const char* which) {
  if (t.size() != y.size())
    throw std::invalid_argument(fmt::format("{}: {} times, {} values", which, t.size(), y.size()));
  if (t.empty()) throw std::invalid_argument(fmt::format("{}: no samples", which));
  if (!std::ranges::is_sorted(t)) throw std::invalid_argument(fmt::format("{}: time goes back", which));
}

double interpolated(const std::vector<double>& t, const std::vector<double>& y, double time) {
  const auto above = static_cast<std::size_t>(std::ranges::lower_bound(t, time) - t.begin());
  if (above == 0) return y.front();
  const double share = (time - t[above - 1]) / (t[above] - t[above - 1]);
  return y[above - 1] + share * (y[above] - y[above - 1]);
}

struct Extremum {
  double time = 0, value = 0;
};

Extremum peak(const std::vector<double>& t, const std::vector<double>& y, double from, double to) {
  Extremum result;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] >= from && t[i] <= to && std::abs(y[i]) > std::abs(result.value)) result = {t[i], y[i]};
  }
  return result;
}

struct Place {
  double x, y;
};

/// What probes.csv says about the probe that is compared.
struct Probe {
  Table history;
  std::optional<Place> place;
};

std::optional<Table> read_if_there(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  return read_csv(path);
}

Table rows_where(const Table& table, const std::function<bool(const Row&)>& wanted) {
  Table result{table.columns, {}};
  std::ranges::copy_if(table.rows, std::back_inserter(result.rows), wanted);
  return result;
}

std::optional<Place> place(const Table& table, const Row& row) {
  const auto x = number(row[table.column("x")]), y = number(row[table.column("y")]);
  return x && y ? std::optional(Place{*x, *y}) : std::nullopt;
}

Probe probe(const Table& probes) {
  const std::size_t name = probes.column("probe");
  Table history = rows_where(probes, [&](const Row& row) { return word(row[name]) == "tip"; });
  if (history.rows.empty() && !probes.rows.empty()) {
    const Cell first = probes.rows.front()[name];
    history = rows_where(probes, [&](const Row& row) { return row[name] == first; });
  }
  const auto where = history.rows.empty() ? std::nullopt : place(history, history.rows.front());
  return {std::move(history), where};
}

/// The rows of the tip that is nearest to `near` at the first time, by the first method listed for it.
Table tip_history(const Table& srifs, const std::optional<Place>& near) {
  const std::size_t time = srifs.column("time"), tip = srifs.column("tip"), method = srifs.column("method");
  const Row* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Row& row : srifs.rows) {
    if (row[time] != srifs.rows.front()[time]) break;
    const auto where = place(srifs, row);
    const double distance = near && where ? std::hypot(where->x - near->x, where->y - near->y) : 0;
    if (distance >= least) continue;
    least = distance;
    nearest = &row;
  }
  return rows_where(srifs,
                    [&](const Row& row) { return row[tip] == (*nearest)[tip] && row[method] == (*nearest)[method]; });
}

/// The reference's columns for a quantity, the best first: F1_J, then F1, F1_paper_LS and so on.
std::vector<std::string> reference_columns(const Table& reference, const std::string& quantity) {
  const bool factor = quantity.starts_with('K') || quantity.starts_with('F');
  std::vector<std::string> names;
  for (const std::string& name : reference.columns) {
    if (name == quantity || (factor && name.starts_with(quantity + "_"))) names.push_back(name);
  }
  std::stable_partition(names.begin(), names.end(), [&](const std::string& name) { return name == quantity + "_J"; });
  return names;
}

template <std::size_t Count>
void add(std::vector<ComparedQuantity>& rows, const Table& computed, const Table& reference,
         const std::array<const char*, Count>& quantities) {
  for (const std::string quantity : quantities) {
    if (!has(computed, quantity)) continue;
    const Curve run = curve(computed, "time", quantity);
    if (run.t.empty()) continue;
    for (const std::string& name : reference_columns(reference, quantity)) {
      const Curve known = curve(reference, "t", name);
      if (std::ranges::all_of(known.y, [](double y) { return y == 0; })) continue;
      rows.push_back({quantity, name, compare(run.t, run.y, known.t, known.y), run, known});
    }
  }
}

std::string percent(double share) {
  const double size = 100 * std::abs(share);
  return size < 100 ? fmt::format("{:.2f} %", size) : fmt::format("{:.4g} %", size);
}

std::string legend(const ComparedQuantity& row) {
  const Comparison& c = row.comparison;
  return fmt::format("reference {}: rms {}, peak error {}{}", row.reference, percent(c.relative_rms),
                     c.peak_error < 0 ? "\u2212" : "+", percent(c.peak_error));
}

}  // namespace

Comparison compare(const std::vector<double>& t, const std::vector<double>& y, const std::vector<double>& reference_t,
                   const std::vector<double>& reference_y) {
  check(t, y, "computed");
  check(reference_t, reference_y, "reference");
  const double from = std::max(t.front(), reference_t.front()), to = std::min(t.back(), reference_t.back());
  Comparison result;
  double differences = 0, squares = 0;
  for (std::size_t i = 0; i < reference_t.size(); ++i) {
    if (reference_t[i] < from || reference_t[i] > to) continue;
    const double difference = interpolated(t, y, reference_t[i]) - reference_y[i];
    differences += difference * difference;
    squares += reference_y[i] * reference_y[i];
    ++result.samples;
  }
  if (result.samples < 2) throw std::invalid_argument(fmt::format("{} samples in common", result.samples));
  if (squares == 0) throw std::invalid_argument("the reference is zero where the curves overlap");
  const Extremum computed = peak(t, y, from, to), reference = peak(reference_t, reference_y, from, to);
  result.relative_rms = std::sqrt(differences / squares);
  result.rms_of_peak = std::sqrt(differences / static_cast<double>(result.samples)) / std::abs(reference.value);
  result.peak_error = (computed.value - reference.value) / reference.value;
  result.peak_computed = computed.value;
  result.peak_reference = reference.value;
  result.time_of_peak_computed = computed.time;
  result.time_of_peak_reference = reference.time;
  return result;
}

std::vector<ComparedQuantity> compare(const std::filesystem::path& results, const std::filesystem::path& reference) {
  const Table curves = read_csv(reference);
  if (!has(curves, "t")) throw std::runtime_error(reference.string() + ": no column t, so it holds no curves");
  std::vector<ComparedQuantity> rows;
  std::optional<Place> near;
  if (const auto probes = read_if_there(results / "probes.csv")) {
    const Probe chosen = probe(*probes);
    near = chosen.place;
    add(rows, chosen.history, curves, std::array{"w", "theta_x", "theta_y"});
  }
  if (const auto srifs = read_if_there(results / "srif.csv")) {
    add(rows, tip_history(*srifs, near), curves, std::array{"F1", "F2", "F3", "K1", "K2", "K3"});
  }
  if (rows.empty()) {
    throw std::runtime_error(
        fmt::format("{} and {} have no curve in common", (results / "{probes,srif}.csv").string(), reference.string()));
  }
  return rows;
}

std::string to_text(const std::vector<ComparedQuantity>& rows) {
  std::string text =
      fmt::format("{:<9} {:<12} {:>7} {:>12} {:>14} {:>11} {:>14} {:>11} {:>11}\n", "quantity", "reference", "samples",
                  "relative rms", "peak", "at time", "reference peak", "at time", "peak error");
  for (const auto& [quantity, reference, c, computed, known] : rows) {
    text += fmt::format("{:<9} {:<12} {:>7} {:>10.3f} % {:>14.6g} {:>11.5g} {:>14.6g} {:>11.5g} {:>+9.3f} %\n",
                        quantity, reference, c.samples, 100 * c.relative_rms, c.peak_computed, c.time_of_peak_computed,
                        c.peak_reference, c.time_of_peak_reference, 100 * c.peak_error);
  }
  return text;
}

CurvePlot plot(const std::vector<ComparedQuantity>& rows, const std::string& title) {
  constexpr std::array lines{Line::reference, Line::second_reference, Line::third_reference};
  CurvePlot result{title, {}};
  for (std::size_t first = 0, next = 0; first < rows.size(); first = next) {
    const std::string& quantity = rows[first].quantity;
    while (next < rows.size() && rows[next].quantity == quantity) ++next;
    const bool normalized_too =
        quantity.starts_with('K') && std::ranges::any_of(rows, [&](const ComparedQuantity& row) {
          return row.quantity.starts_with('F') && row.quantity.substr(1) == quantity.substr(1);
        });
    if (normalized_too) continue;
    Panel panel{"time", described(quantity), {}};
    for (std::size_t i = first; i < next; ++i)
      panel.series.push_back({legend(rows[i]), lines[std::min(i - first, lines.size() - 1)], rows[i].known});
    panel.series.push_back({"computed", Line::computed, rows[first].computed});
    result.panels.push_back(std::move(panel));
  }
  return result;
}

std::string title_of(const std::filesystem::path& results) {
  std::ifstream file(results / "summary.json");
  const auto summary = nlohmann::json::parse(file, nullptr, false);  // not JSON: a value that is no object
  if (summary.is_object() && summary.contains("title") && summary["title"].is_string()) return summary["title"];
  const auto folder = std::filesystem::absolute(results).lexically_normal();
  return (folder.has_filename() ? folder : folder.parent_path()).filename().string();
}

}  // namespace post
