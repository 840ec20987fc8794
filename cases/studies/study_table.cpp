#include "cases/studies/study_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "cases/studies/comparison.hpp"
#include "cases/studies/ledger.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"

namespace cases {
namespace {

/// Compares the history of a quantity with a curve.
void compare_with(StudyRow& row, const KnownCurve& known, const post::Curve& computed) {
  row.source = fmt::format("{} {}", known.file.filename().string(), known.column);
  const auto found = compare(computed.t, computed.y, known.curve.t, known.curve.y);
  if (const auto* reason = std::get_if<std::string>(&found)) {
    row.message = *reason;
    return;
  }
  const auto& result = std::get<Comparison>(found);
  row.computed = result.peak_computed;
  row.reference = result.peak_reference;
  row.rms_error = result.rms_of_peak;
}

}  // namespace

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

std::vector<Wanted> wanted(const std::vector<post::Quantity>& listed, const std::vector<Reference>& references,
                           const std::vector<std::string>& axes, const std::vector<std::string>& labels,
                           const std::function<bool(std::size_t reference, bool matches)>& has) {
  std::vector<Wanted> result;
  for (const auto& quantity : listed)
    if (std::ranges::find(result, quantity, &Wanted::quantity) == result.end())
      result.push_back({quantity, std::nullopt});
  for (std::size_t i = 0; i < references.size(); ++i) {
    const auto& quantity = references[i].quantity;
    const bool matched = matches(references[i], axes, labels);
    if (!has(i, matched)) continue;
    auto known = std::ranges::find(result, quantity, &Wanted::quantity);
    if (known == result.end()) known = result.insert(known, {quantity, std::nullopt});
    if (!matched) continue;
    known->reference = references[i].known;
    known->source = references[i].source;
    known->scale = references[i].scale;
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

std::string plain_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '+' ||
                       c == '-' || (c == '.' && !name.empty());
    if (plain || !name.ends_with('_')) name += plain ? c : '_';
  }
  constexpr std::size_t longest = 100;  // file systems take 255
  name = name.substr(0, longest);
  return name.ends_with('_') && name.size() > 1 ? name.substr(0, name.size() - 1) : name;
}

std::string folder_name(const std::vector<std::string>& labels, const std::set<std::string>& taken) {
  std::string name = plain_name(fmt::format("{}", fmt::join(labels, "_")));
  if (name.empty()) name = "run";
  const auto is_file = [](const std::string& text) {
    return std::ranges::any_of(std::array{".csv", ".svg", ".json", ".html", ".partial"},
                               [&](const char* end) { return text.ends_with(end); });
  };
  std::string free = name;
  for (int count = 2; taken.contains(free) || is_file(free); ++count) free = fmt::format("{}-{}", name, count);
  return free;
}

std::optional<double> StudyRow::error() const {
  const auto unit = scale ? scale : reference;
  if (rms_error || !computed || !reference || *unit == 0) return rms_error;
  return (*computed - *reference) / *unit;
}

std::optional<double> StudyRow::estimated_error() const {
  const auto unit = scale ? scale : reference ? reference : against_finest ? std::nullopt : computed;
  if (rms_error || !estimated || !unit || *unit == 0) return std::nullopt;
  return *estimated / std::abs(*unit);
}

double StudyRow::seconds_of(const std::string& stage) const {
  for (const auto& [name, spent] : stage_seconds)
    if (name == stage) return spent;
  return 0;
}

std::vector<StudyRow> study_rows(const StudyRow& run, const std::vector<Wanted>& wanted, const post::Summary& summary,
                                 const std::filesystem::path& folder) {
  StudyRow common = run;
  common.points = summary.points;
  common.stage_seconds = summary.seconds;
  common.outcome = RunOutcome::done;
  common.iterations = summary.analysis.iterations ? summary.analysis.iterations : summary.analysis.steps;
  for (const auto& [stage, spent] : summary.seconds) {
    if (stage == "total") common.seconds = spent;
    if (stage == "solve") common.solve_seconds = spent;
  }
  std::vector<StudyRow> rows;
  for (const auto& [quantity, reference, source, scale] : wanted) {
    auto& row = rows.emplace_back(common);
    row.quantity = quantity.name;
    row.place = quantity.place();
    row.method = quantity.method;
    row.source = source;
    row.computed = post::value(quantity, summary, folder);
    if (!row.computed) row.message = post::lack(quantity, summary);
    if (row.computed) row.estimated = post::estimated_error(quantity, summary);
    if (!reference || !row.computed) continue;
    row.scale = scale;
    row.against_finest = std::holds_alternative<Finest>(*reference);
    if (const auto* number = std::get_if<double>(&*reference)) row.reference = *number;
    if (const auto* known = std::get_if<KnownCurve>(&*reference))
      compare_with(row, *known, post::history(quantity, folder));
  }
  return rows.empty() ? std::vector{common} : rows;
}

namespace {

template <class Number>
std::string shown(const char* format, const std::optional<Number>& number) {
  return number ? fmt::format(fmt::runtime(format), *number) : "";
}

/// The seconds of a stage; nothing of a run that has not ended well.
post::Cell cell_of(const StudyRow& row, const char* stage) {
  return row.stage_seconds.empty() ? post::Cell() : post::Cell(row.seconds_of(stage));
}

/// A column that study.csv and the printed table have beside those of the axes.
struct Column {
  const char *name, *title;  // in study.csv; printed, or nullptr
  std::function<post::Cell(const StudyRow&)> cell;
  std::function<std::string(const StudyRow&)> text;  // nothing: the word of the cell, to the left
};

const std::vector<Column>& own_columns() {
  using Row = const StudyRow&;
  static const std::vector<Column> columns{
      {"quantity", "quantity", [](Row row) { return post::cell(row.quantity); }, {}},
      {"place", "place", [](Row row) { return post::cell(row.place); }, {}},
      {"srif_method", "method", [](Row row) { return post::cell(row.method); }, {}},
      {"computed", "computed", [](Row row) { return post::cell(row.computed); },
       [](Row row) { return shown("{:.6g}", row.computed); }},
      {"reference", "reference", [](Row row) { return post::cell(row.reference); },
       [](Row row) { return shown("{:.6g}", row.reference); }},
      {"error", "error %", [](Row row) { return post::cell(row.error()); },
       [](Row row) { return row.error() ? fmt::format("{:+.3f}", 100 * *row.error()) : ""; }},
      {"estimated_error", "estimated %", [](Row row) { return post::cell(row.estimated_error()); },
       [](Row row) { return row.estimated_error() ? fmt::format("{:.2g}", 100 * *row.estimated_error()) : ""; }},
      {"points", "points", [](Row row) { return post::cell(row.points); },
       [](Row row) { return shown("{}", row.points); }},
      {"spacing", "spacing", [](Row row) { return post::cell(row.spacing); },
       [](Row row) { return shown("{:.5g}", row.spacing); }},
      {"horizon", "horizon", [](Row row) { return post::cell(row.horizon); },
       [](Row row) { return shown("{:.5g}", row.horizon); }},
      {"iterations", "iterations", [](Row row) { return post::cell(row.iterations); },
       [](Row row) { return shown("{}", row.iterations); }},
      {"seconds", "seconds", [](Row row) { return post::cell(row.seconds); },
       [](Row row) { return shown("{:.2f}", row.seconds); }},
      {"processor_seconds", "processor", [](Row row) { return cell_of(row, "processor"); },
       [](Row row) { return row.stage_seconds.empty() ? "" : fmt::format("{:.2f}", row.seconds_of("processor")); }},
      {"solve_seconds", "solve", [](Row row) { return post::cell(row.solve_seconds); },
       [](Row row) { return shown("{:.2f}", row.solve_seconds); }},
      {"seconds_min", nullptr, [](Row row) { return post::cell(row.seconds_min); }, {}},
      {"seconds_max", nullptr, [](Row row) { return post::cell(row.seconds_max); }, {}},
      {"geometry_seconds", nullptr, [](Row row) { return cell_of(row, "geometry"); }, {}},
      {"families_seconds", nullptr, [](Row row) { return cell_of(row, "families"); }, {}},
      {"parameters_seconds", nullptr, [](Row row) { return cell_of(row, "parameters"); }, {}},
      {"srif_seconds", nullptr, [](Row row) { return cell_of(row, "srif"); }, {}},
      {"output_seconds", nullptr, [](Row row) { return cell_of(row, "output"); }, {}},
      {"reference_source", nullptr, [](Row row) { return post::cell(row.source); }, {}},
      {"outcome", nullptr, [](Row row) { return post::cell(name_of(row.outcome)); }, {}},
      {"message", "", [](Row row) { return post::cell(row.message); }, {}}};
  return columns;
}

/// The study's own columns, without those that an axis stands for.
std::vector<Column> columns_beside(const std::vector<std::string>& axes) {
  auto result = own_columns();
  std::erase_if(result, [&](const Column& c) { return std::ranges::find(axes, c.name) != axes.end(); });
  return result;
}

/// True for columns to print: columns that only some studies have are left out where no row has a value.
bool is_wanted_in_text(const StudyTable& study, const Column& column) {
  if (!column.title) return false;
  const std::string name = column.name;
  if (name != "srif_method" && name != "reference" && name != "error" && name != "estimated_error") return true;
  return std::ranges::any_of(study.rows, [&](const StudyRow& row) { return column.cell(row) != post::Cell(); });
}

}  // namespace

const std::vector<std::string>& study_columns() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const auto& column : own_columns()) result.emplace_back(column.name);
    return result;
  }();
  return names;
}

post::Table table(const StudyTable& study) {
  const auto own = columns_beside(study.axes);
  post::Table result{study.axes, {}};
  for (const auto& column : own) result.columns.emplace_back(column.name);
  for (const auto& row : study.rows) {
    std::vector<post::Cell> cells(row.labels.begin(), row.labels.end());
    for (const auto& column : own) cells.push_back(column.cell(row));
    result.rows.push_back(std::move(cells));
  }
  return result;
}

std::string costs_text(const StudyTable& study) {
  constexpr std::array stages{"processor", "geometry", "families", "parameters", "solve", "srif", "output"};
  std::vector<post::TextColumn> columns;
  for (const auto& axis : study.axes) columns.push_back({axis, false, {}});
  for (const char* name : {"median s", "least", "most"}) columns.push_back({name, true, {}});
  for (const char* name : stages) columns.push_back({name, true, {}});
  const StudyRow* before = nullptr;
  for (const auto& row : study.rows) {
    const bool again = before && before->labels == row.labels;  // another quantity of the same run
    before = &row;
    if (again || row.stage_seconds.empty()) continue;
    std::vector<std::string> cells = row.labels;
    for (const auto& spent : {row.seconds, row.seconds_min, row.seconds_max}) cells.push_back(shown("{:.3f}", spent));
    for (const char* name : stages) cells.push_back(fmt::format("{:.3f}", row.seconds_of(name)));
    for (std::size_t i = 0; i < cells.size(); ++i) columns[i].cells.push_back(cells[i]);
  }
  return post::aligned(columns);
}

std::string to_text(const StudyRow& row) {
  std::vector<std::string> parts;
  if (row.computed)
    parts.push_back(fmt::format("{}{}{} = {:.6g}", row.quantity, row.place.empty() ? "" : " at " + row.place,
                                row.method.empty() ? "" : " by " + row.method, *row.computed));
  if (const auto error = row.error())
    parts.push_back(fmt::format("error {:+.3f} %", 100 * *error));
  else if (const auto estimated = row.estimated_error())
    parts.push_back(fmt::format("estimated error {:.2g} %", 100 * *estimated));
  if (row.points) parts.push_back(fmt::format("{} points", *row.points));
  if (row.iterations) parts.push_back(fmt::format("{} iterations", *row.iterations));
  if (row.seconds) parts.push_back(fmt::format("{:.1f} s", *row.seconds));
  if (!row.message.empty()) parts.push_back(post::one_line(row.message));
  return fmt::format("{}{}{}", fmt::join(row.labels, ", "), row.labels.empty() ? "" : ": ", fmt::join(parts, ", "));
}

std::string to_text(const StudyTable& study) {
  std::vector<post::TextColumn> columns;
  const auto add = [&](const std::string& title, bool number, const std::function<std::string(const StudyRow&)>& text) {
    columns.push_back({title, number, {}});
    for (const auto& row : study.rows) columns.back().cells.push_back(text(row));
  };
  for (std::size_t axis = 0; axis < study.axes.size(); ++axis)
    add(study.axes[axis], false, [axis](const StudyRow& row) { return row.labels.at(axis); });
  for (const auto& column : columns_beside(study.axes)) {
    if (!is_wanted_in_text(study, column)) continue;
    if (column.text)
      add(column.title, true, column.text);
    else
      add(column.title, false, [&](const StudyRow& row) {
        const post::Cell found = column.cell(row);
        return post::one_line(std::holds_alternative<std::string>(found) ? std::get<std::string>(found) : "");
      });
  }
  return post::aligned(columns);
}

}  // namespace cases
