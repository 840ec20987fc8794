#include "cases/studies/comparison.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "plate/model/wording.hpp"
#include "post/files/atomic_file.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "post/report/html_page.hpp"
#include "post/report/quantity.hpp"

namespace cases {
namespace {

using Row = std::vector<post::Cell>;

std::optional<double> cell_number(const post::Cell& cell) {
  const auto* value = std::get_if<double>(&cell);
  return value && std::isfinite(*value) ? std::optional(*value) : std::nullopt;
}

bool has(const post::Table& table, const std::string& name) {
  return std::ranges::find(table.columns, name) != table.columns.end();
}

std::optional<post::Table> read_if_there(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  return post::read_csv(path);
}

post::Table rows_where(const post::Table& table, const std::function<bool(const Row&)>& wanted) {
  post::Table result{table.columns, {}};
  std::ranges::copy_if(table.rows, std::back_inserter(result.rows), wanted);
  return result;
}

std::optional<geometry::Point> place(const post::Table& table, const Row& row) {
  const auto x = cell_number(row[table.column("x")]), y = cell_number(row[table.column("y")]);
  return x && y ? std::optional(geometry::Point(*x, *y)) : std::nullopt;
}

/// Rows of probes.csv for a probe; none where there is no such one.
post::Table rows_of_probe(const post::Table& probes, const std::string& probe) {
  const std::size_t name = probes.column("probe");
  return rows_where(probes, [&](const Row& row) { return row[name] == post::Cell(probe); });
}

/// Rows of probes.csv for the probe that is compared.
post::Table probe(const post::Table& probes) {
  const std::size_t name = probes.column("probe");
  post::Table history = rows_of_probe(probes, "tip");
  if (history.rows.empty() && !probes.rows.empty()) {
    const post::Cell first = probes.rows.front()[name];
    history = rows_where(probes, [&](const Row& row) { return row[name] == first; });
  }
  return history;
}

/// The rows of the tip that is nearest to `near` at the first time, by the first method listed for it.
post::Table tip_history(const post::Table& srifs, const std::optional<geometry::Point>& near) {
  const std::size_t time = srifs.column("time"), tip = srifs.column("tip"), method = srifs.column("method");
  const Row* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Row& row : srifs.rows) {
    if (row[time] != srifs.rows.front()[time]) break;
    const auto where = place(srifs, row);
    const double distance = near && where ? std::hypot(where->x() - near->x(), where->y() - near->y()) : 0;
    if (distance >= least) continue;
    least = distance;
    nearest = &row;
  }
  return rows_where(srifs,
                    [&](const Row& row) { return row[tip] == (*nearest)[tip] && row[method] == (*nearest)[method]; });
}

/// The reference's columns for a quantity, the best first: F1_J, then F1, F1_paper_LS and so on.
std::vector<std::string> reference_columns(const post::Table& reference, const std::string& quantity) {
  const bool factor = quantity.starts_with('K') || quantity.starts_with('F') || quantity.starts_with('N');
  std::vector<std::string> names;
  for (const std::string& name : reference.columns) {
    if (name == quantity || (factor && name.starts_with(quantity + "_"))) names.push_back(name);
  }
  std::stable_partition(names.begin(), names.end(), [&](const std::string& name) { return name == quantity + "_J"; });
  return names;
}

void add(std::vector<ComparedQuantity>& rows, const post::Table& computed, const post::Table& reference,
         std::initializer_list<std::string> quantities) {
  for (const auto& quantity : quantities) {
    if (!has(computed, quantity)) continue;
    const post::Curve run = curve(computed, "time", quantity);
    if (run.t.empty()) continue;
    for (const std::string& name : reference_columns(reference, quantity)) {
      const post::Curve known = curve(reference, "t", name);
      if (std::ranges::all_of(known.y, [](double y) { return y == 0; })) continue;
      const auto found = compare(run.t, run.y, known.t, known.y);
      if (const auto* reason = std::get_if<std::string>(&found))
        throw std::invalid_argument(fmt::format("{}: {}", name, *reason));
      rows.push_back({.quantity = quantity,
                      .reference = name,
                      .comparison = std::get<Comparison>(found),
                      .computed = run,
                      .known = known});
    }
  }
}

/// Compares the probe `ahead` with the columns for a place ahead of the tip.
void add_ahead(std::vector<ComparedQuantity>& rows, const post::Table& probes, const post::Table& reference) {
  constexpr std::array<std::pair<const char*, const char*>, 3> columns{
      {{"w_a", "w"}, {"tx_a", "theta_x"}, {"ty_a", "theta_y"}}};
  const auto history = rows_of_probe(probes, "ahead");
  for (const auto& [column, quantity] : columns) {
    if (history.rows.empty() || !has(reference, column)) continue;
    post::Table renamed = reference;
    const std::size_t first = rows.size();
    for (auto& name : renamed.columns)
      if (name == quantity)
        name = "";
      else if (name == column)
        name = quantity;
    add(rows, history, renamed, {quantity});
    for (std::size_t i = first; i < rows.size(); ++i) rows[i].reference = column;
  }
}

/// Notes that rotations are singular where the probe is at a tip.
void note_singular_rotations(std::vector<ComparedQuantity>& rows, const post::Table& srifs,
                             const geometry::Point& probe, const post::Table& reference) {
  constexpr double same_place = 1e-6;  // of the distance from the origin
  const bool at_tip = std::ranges::any_of(srifs.rows, [&](const Row& row) {
    const auto tip = place(srifs, row);
    return tip && (*tip - probe).norm() <= same_place * (1 + probe.norm());
  });
  for (auto& row : rows)
    if (at_tip && row.quantity.starts_with("theta"))
      row.note = fmt::format("the probe is at a crack tip, where rotations are singular: take a probe {}",
                             has(reference, "ty_a") ? "`ahead` at the place of the columns tx_a, ty_a" : "beside it");
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

std::vector<ComparedQuantity> compare(const std::filesystem::path& results, const std::filesystem::path& reference) {
  const post::Table curves = post::read_csv(reference);
  if (!has(curves, "t")) throw std::invalid_argument("no column t, so it holds no curves");
  std::vector<ComparedQuantity> rows;
  std::optional<geometry::Point> near;
  if (const auto probes = read_if_there(results / "probes.csv")) {
    const post::Table history = probe(*probes);
    if (!history.rows.empty()) near = place(history, history.rows.front());
    add(rows, history, curves, {"w", "theta_x", "theta_y", "u", "v"});
    if (const auto srifs = read_if_there(results / "srif.csv"); near && srifs)
      note_singular_rotations(rows, *srifs, *near, curves);
    add_ahead(rows, *probes, curves);
  }
  if (const auto srifs = read_if_there(results / "srif.csv"))
    add(rows, tip_history(*srifs, near), curves, {"F1", "F2", "F3", "K1", "K2", "K3", "N1", "N2"});
  if (rows.empty()) {
    throw std::invalid_argument(fmt::format("no curve in common with {}", (results / "{probes,srif}.csv").string()));
  }
  return rows;
}

Tolerances tolerances(const std::vector<std::string>& texts, std::optional<double> all) {
  Tolerances result{{}, all};
  std::vector<std::string> names;
  for (const auto& [name, unused] : measures({.shift = 0})) names.push_back(name);  // the shift, too
  for (const auto& text : texts) {
    const auto equals = std::min(text.find('='), text.size());
    const std::string name = text.substr(0, equals);
    if (std::ranges::find(names, name) == names.end())
      throw std::invalid_argument(fmt::format("\"{}\" given, must be one of {}{}", name, plate::listed(names),
                                              plate::did_you_mean(name, names)));
    double value = -1;
    const char *first = text.data() + std::min(equals + 1, text.size()), *last = text.data() + text.size();
    const auto [end, error] = std::from_chars(first, last, value);
    if (end != last || first == last || error != std::errc{} || !(value >= 0) || !std::isfinite(value))
      throw std::invalid_argument(fmt::format("\"{}\" given, must be {}=NUMBER with a number >= 0", text, name));
    result.by_measure[name] = value;
  }
  return result;
}

std::vector<Exceeded> exceeded(const std::vector<ComparedQuantity>& rows, const Tolerances& tolerances) {
  std::vector<Exceeded> result;
  for (const auto& row : rows)
    for (const auto& [name, found] : measures(row.comparison)) {
      const auto own = tolerances.by_measure.find(name);
      const auto allowed = own != tolerances.by_measure.end() ? std::optional(own->second) : tolerances.all;
      if (allowed && !(found <= *allowed)) result.push_back({row.quantity, row.reference, name, found, *allowed});
    }
  return result;
}

std::string to_json(const std::vector<ComparedQuantity>& rows, const std::vector<Exceeded>& above) {
  using Json = nlohmann::ordered_json;
  Json json{{"within", above.empty()}, {"quantities", Json::array()}, {"exceeded", Json::array()}};
  for (const auto& [quantity, reference, c, computed, known, note] : rows) {
    Json row{{"quantity", quantity},
             {"reference", reference},
             {"samples", c.samples},
             {"from", c.from},
             {"to", c.to},
             {"covered", c.covered},
             {"l2", c.relative_l2},
             {"max", c.relative_max},
             {"rms", c.relative_rms},
             {"rms_of_peak", c.rms_of_peak}};
    row["peak"] = {{"computed", c.peak_computed},
                   {"reference", c.peak_reference},
                   {"error", c.peak_error},
                   {"time_computed", c.time_of_peak_computed},
                   {"time_reference", c.time_of_peak_reference},
                   {"time_error", c.peak_time_error}};
    if (c.shift) row["shift"] = {{"time", *c.shift}, {"relative", *c.relative_shift()}};
    if (!note.empty()) row["note"] = note;
    json["quantities"].push_back(std::move(row));
  }
  for (const auto& [quantity, reference, measure, found, allowed] : above)
    json["exceeded"].push_back({{"quantity", quantity},
                                {"reference", reference},
                                {"measure", measure},
                                {"found", found},
                                {"allowed", allowed}});
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string to_text(const std::vector<Exceeded>& above) {
  std::string text;
  for (const auto& [quantity, reference, measure, found, allowed] : above)
    text += fmt::format("{} against {}: {} is {:.4g}, above {:g}\n", quantity, reference, measure, found, allowed);
  return text;
}

std::string to_text(const std::vector<ComparedQuantity>& rows) {
  std::vector<post::TextColumn> columns;
  const auto add = [&](const std::string& title, bool number,
                       const std::function<std::string(const ComparedQuantity&)>& text) {
    columns.push_back({title, number, {}});
    for (const auto& row : rows) columns.back().cells.push_back(text(row));
  };
  using Row = const ComparedQuantity&;
  const auto shown = [](double share) { return fmt::format("{:.3f} %", 100 * share); };
  const auto sided = [](double share) { return fmt::format("{:+.3f} %", 100 * share); };
  add("quantity", false, [](Row row) { return row.quantity; });
  add("reference", false, [](Row row) { return row.reference; });
  add("samples", true, [](Row row) { return fmt::format("{}", row.comparison.samples); });
  add("relative rms", true, [&](Row row) { return shown(row.comparison.relative_rms); });
  add("L2", true, [&](Row row) { return shown(row.comparison.relative_l2); });
  add("max", true, [&](Row row) { return shown(row.comparison.relative_max); });
  add("peak", true, [](Row row) { return fmt::format("{:.6g}", row.comparison.peak_computed); });
  add("at time", true, [](Row row) { return fmt::format("{:.5g}", row.comparison.time_of_peak_computed); });
  add("reference peak", true, [](Row row) { return fmt::format("{:.6g}", row.comparison.peak_reference); });
  add("at time", true, [](Row row) { return fmt::format("{:.5g}", row.comparison.time_of_peak_reference); });
  add("peak error", true, [&](Row row) { return sided(row.comparison.peak_error); });
  add("peak time", true, [&](Row row) { return sided(row.comparison.peak_time_error); });
  add("shift", true, [&](Row row) {
    const auto shift = row.comparison.relative_shift();
    return shift ? sided(*shift) : std::string();
  });
  std::string text = post::aligned(columns);
  for (const auto& row : rows)
    if (const auto& c = row.comparison; c.covered < 0.999) {
      text += fmt::format("compared from {:g} to {:g}, {:.0f} % of the range of the reference\n", c.from, c.to,
                          100 * c.covered);
      break;
    }
  for (const auto& row : rows)
    if (!row.note.empty()) text += fmt::format("{}: {}\n", row.quantity, row.note);
  return text;
}

post::CurvePlot plot(const std::vector<ComparedQuantity>& rows, const std::string& title, bool si) {
  constexpr std::array lines{post::Line::reference, post::Line::second_reference, post::Line::third_reference};
  post::CurvePlot result{title, {}};
  for (std::size_t first = 0, next = 0; first < rows.size(); first = next) {
    const std::string& quantity = rows[first].quantity;
    while (next < rows.size() && rows[next].quantity == quantity) ++next;
    const bool normalized_too =
        quantity.starts_with('K') && std::ranges::any_of(rows, [&](const ComparedQuantity& row) {
          return row.quantity.starts_with('F') && row.quantity.substr(1) == quantity.substr(1);
        });
    if (normalized_too) continue;
    const auto unit = si ? post::si_unit(quantity) : std::string();
    post::Panel panel{
        si ? "time [s]" : "time",
        unit.empty() ? post::described(quantity) : fmt::format("{} [{}]", post::described(quantity), unit),
        {}};
    for (std::size_t i = first; i < next; ++i)
      panel.series.push_back({legend(rows[i]), lines[std::min(i - first, lines.size() - 1)], rows[i].known});
    panel.series.push_back({"computed", post::Line::computed, rows[first].computed});
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

ComparedRun compared(const std::filesystem::path& folder, const std::filesystem::path& reference,
                     const Tolerances& tolerances) {
  if (!std::filesystem::exists(reference)) throw std::invalid_argument("no such file");
  auto rows = compare(folder, reference);
  auto above = exceeded(rows, tolerances);
  return {folder, std::move(rows), std::move(above)};
}

std::string to_text(const ComparedRun& run) {
  return to_text(run.rows) + to_text(run.above);
}

void write(const ComparedRun& run, const std::filesystem::path& drawing, const std::filesystem::path& json) {
  if (!drawing.empty()) {
    const auto summary = post::read_summary(run.folder / "summary.json");
    const auto curves = plot(run.rows, title_of(run.folder), summary && summary->units == "SI");
    const bool page = drawing.extension() == ".html";
    post::write_atomically(drawing, page ? post::comparison_page(curves, to_text(run.rows)) : post::to_svg(curves));
  }
  if (!json.empty()) post::write_atomically(json, to_json(run.rows, run.above));
}

}  // namespace cases
