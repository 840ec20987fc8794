#include "post/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "post/aligned.hpp"

namespace post {
namespace {

std::optional<double> finite(const Cell& cell) {
  const auto* number = std::get_if<double>(&cell);
  return number && std::isfinite(*number) ? std::optional(*number) : std::nullopt;
}

/// The cell of a column in the last row that is wanted: tables grow with time.
std::optional<double> last(const std::filesystem::path& path, const std::string& column,
                           const std::function<bool(const Table&, const std::vector<Cell>&)>& wanted) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  const Table table = read_csv(path);
  for (auto row = table.rows.rbegin(); row != table.rows.rend(); ++row)
    if (wanted(table, *row)) return finite((*row)[table.column(column)]);
  return std::nullopt;
}

std::optional<double> factor(const std::string& name, const Srif& srif) {
  if (name == "K1") return srif.K1;
  if (name == "K2") return srif.K2;
  if (name == "K3") return srif.K3;
  if (name == "F1") return srif.F1;
  if (name == "F2") return srif.F2;
  if (name == "F3") return srif.F3;
  return std::nullopt;
}

template <class Number>
Cell cell(const std::optional<Number>& number) {
  return number ? Cell(static_cast<double>(*number)) : Cell();
}

Cell cell(const std::string& word) {
  return word.empty() ? Cell() : Cell(word);
}

template <class Number>
std::string shown(const char* format, const std::optional<Number>& number) {
  return number ? fmt::format(fmt::runtime(format), *number) : "";
}

std::vector<TextColumn> columns(const StudyTable& study) {
  std::vector<TextColumn> result;
  const auto add = [&](const std::string& title, bool number, const std::function<std::string(const StudyRow&)>& text) {
    result.push_back({title, number, {}});
    for (const auto& row : study.rows) result.back().cells.push_back(text(row));
  };
  for (std::size_t axis = 0; axis < study.axes.size(); ++axis)
    add(study.axes[axis], false, [axis](const StudyRow& row) { return row.labels.at(axis); });
  add("quantity", false, [](const StudyRow& row) { return row.quantity; });
  add("place", false, [](const StudyRow& row) { return row.place; });
  add("computed", true, [](const StudyRow& row) { return shown("{:.6g}", row.computed); });
  add("reference", true, [](const StudyRow& row) { return shown("{:.6g}", row.reference); });
  add("error %", true, [](const StudyRow& row) {
    const auto error = row.error();
    return error ? fmt::format("{:+.3f}", 100 * *error) : "";
  });
  add("points", true, [](const StudyRow& row) { return shown("{}", row.points); });
  add("spacing", true, [](const StudyRow& row) { return shown("{:.5g}", row.spacing); });
  add("iterations", true, [](const StudyRow& row) { return shown("{}", row.iterations); });
  add("seconds", true, [](const StudyRow& row) { return shown("{:.2f}", row.seconds); });
  add("solve", true, [](const StudyRow& row) { return shown("{:.2f}", row.solve_seconds); });
  add("", false, [](const StudyRow& row) { return one_line(row.message); });
  return result;
}

}  // namespace

std::string Quantity::place() const {
  return tip ? fmt::format("tip {}", *tip) : probe.value_or("");
}

std::optional<double> value(const Quantity& quantity, const Summary& summary, const std::filesystem::path& folder) {
  const auto any = [](const Table&, const std::vector<Cell>&) { return true; };
  if (quantity.probe)
    return last(folder / "probes.csv", quantity.name, [&](const Table& table, const std::vector<Cell>& row) {
      return row[table.column("probe")] == Cell(*quantity.probe);
    });
  if (quantity.name == "strain_energy") return last(folder / "history.csv", quantity.name, any);
  const auto srif = std::ranges::find(summary.srif, quantity.tip, [](const Srif& s) { return std::optional(s.tip); });
  const auto found = srif == summary.srif.end() ? std::nullopt : factor(quantity.name, *srif);
  return found && std::isfinite(*found) ? found : std::nullopt;
}

const std::vector<std::string>& quantity_names() {
  static const std::vector<std::string> names{"K1", "K2", "K3",      "F1",      "F2",
                                              "F3", "w",  "theta_x", "theta_y", "strain_energy"};
  return names;
}

std::string kind_of_place(const std::string& quantity) {
  if (quantity == "strain_energy") return "";
  return quantity.starts_with('K') || quantity.starts_with('F') ? "tip" : "probe";
}

bool matches(const Reference& reference, const std::vector<std::string>& axes, const std::vector<std::string>& labels) {
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    const auto label = reference.where.find(axes[axis]);
    if (label != reference.where.end() && label->second != labels.at(axis)) return false;
  }
  return true;
}

bool overlap(const Reference& one, const Reference& other) {
  const bool apart = std::ranges::any_of(one.where, [&](const auto& entry) {
    const auto same = other.where.find(entry.first);
    return same != other.where.end() && same->second != entry.second;
  });
  return !apart && one.quantity == other.quantity;
}

std::vector<Wanted> wanted(const std::vector<Reference>& references, const std::vector<std::string>& axes,
                           const std::vector<std::string>& labels,
                           const std::function<bool(std::size_t reference, bool matches)>& has) {
  std::vector<Wanted> result;
  for (std::size_t i = 0; i < references.size(); ++i) {
    const auto& quantity = references[i].quantity;
    const bool matched = matches(references[i], axes, labels);
    if (!has(i, matched)) continue;
    auto known = std::ranges::find(result, quantity, &Wanted::quantity);
    if (known == result.end()) known = result.insert(known, {quantity, std::nullopt});
    if (matched) known->reference = references[i].value;
  }
  return result;
}

std::vector<std::vector<std::size_t>> combinations(const std::vector<std::size_t>& sizes) {
  std::vector<std::vector<std::size_t>> result{{}};
  for (const std::size_t size : sizes) {
    std::vector<std::vector<std::size_t>> longer;
    for (const auto& combination : result)
      for (std::size_t i = 0; i < size; ++i) {
        longer.push_back(combination);
        longer.back().push_back(i);
      }
    result = std::move(longer);
  }
  return result;
}

std::string folder_name(const std::vector<std::string>& labels, const std::set<std::string>& taken) {
  std::string name;
  for (const char c : fmt::format("{}", fmt::join(labels, "_"))) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '+' ||
                       c == '-' || (c == '.' && !name.empty());
    if (plain || !name.ends_with('_')) name += plain ? c : '_';
  }
  constexpr std::size_t longest = 100;  // file systems take 255
  name = name.empty() ? "run" : name.substr(0, longest);
  std::string free = name;
  for (int count = 2; taken.contains(free) || free == "study.csv" || free == "study.csv.partial"; ++count)
    free = fmt::format("{}-{}", name, count);
  return free;
}

std::optional<double> StudyRow::error() const {
  if (!computed || !reference || *reference == 0) return std::nullopt;
  return (*computed - *reference) / *reference;
}

std::vector<StudyRow> study_rows(const StudyRow& run, const std::vector<Wanted>& wanted, const Summary& summary,
                                 const std::filesystem::path& folder) {
  StudyRow common = run;
  common.points = summary.points;
  common.iterations = summary.analysis.iterations ? summary.analysis.iterations : summary.analysis.steps;
  for (const auto& [stage, spent] : summary.seconds) {
    if (stage == "total") common.seconds = spent;
    if (stage == "solve") common.solve_seconds = spent;
  }
  std::vector<StudyRow> rows;
  for (const auto& [quantity, reference] : wanted) {
    rows.push_back(common);
    rows.back().quantity = quantity.name;
    rows.back().place = quantity.place();
    rows.back().reference = reference;
    rows.back().computed = value(quantity, summary, folder);
    if (!rows.back().computed) rows.back().message = "the results have no such number";
  }
  return rows.empty() ? std::vector{common} : rows;
}

const std::vector<std::string>& study_columns() {
  static const std::vector<std::string> names{"quantity", "place",      "computed", "reference",     "error",  "points",
                                              "spacing",  "iterations", "seconds",  "solve_seconds", "message"};
  return names;
}

Table table(const StudyTable& study) {
  Table result{study.axes, {}};
  result.columns.insert(result.columns.end(), study_columns().begin(), study_columns().end());
  for (const auto& row : study.rows) {
    std::vector<Cell> cells(row.labels.begin(), row.labels.end());
    for (Cell value : {cell(row.quantity), cell(row.place), cell(row.computed), cell(row.reference), cell(row.error()),
                       cell(row.points), cell(row.spacing), cell(row.iterations), cell(row.seconds),
                       cell(row.solve_seconds), cell(row.message)})
      cells.push_back(std::move(value));
    result.rows.push_back(std::move(cells));
  }
  return result;
}

std::string to_text(const StudyRow& row) {
  std::vector<std::string> parts;
  if (row.computed)
    parts.push_back(
        fmt::format("{}{} = {:.6g}", row.quantity, row.place.empty() ? "" : " at " + row.place, *row.computed));
  if (const auto error = row.error()) parts.push_back(fmt::format("error {:+.3f} %", 100 * *error));
  if (row.points) parts.push_back(fmt::format("{} points", *row.points));
  if (row.iterations) parts.push_back(fmt::format("{} iterations", *row.iterations));
  if (row.seconds) parts.push_back(fmt::format("{:.1f} s", *row.seconds));
  if (!row.message.empty()) parts.push_back(one_line(row.message));
  return fmt::format("{}{}{}", fmt::join(row.labels, ", "), row.labels.empty() ? "" : ": ", fmt::join(parts, ", "));
}

std::string to_text(const StudyTable& study) {
  return aligned(columns(study));
}

}  // namespace post
