#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>

#include "post/figures/aligned.hpp"
#include "post/files/table.hpp"
#include "post/studies/study.hpp"

namespace post {
namespace {

template <class Number>
std::string shown(const char* format, const std::optional<Number>& number) {
  return number ? fmt::format(fmt::runtime(format), *number) : "";
}

/// The seconds of a stage; nothing of a run that has not ended well.
Cell cell_of(const StudyRow& row, const char* stage) {
  return row.stage_seconds.empty() ? Cell() : Cell(row.seconds_of(stage));
}

/// A column that study.csv and the printed table have beside those of the axes.
struct Column {
  const char *name, *title;  // in study.csv; printed, or nullptr
  std::function<Cell(const StudyRow&)> cell;
  std::function<std::string(const StudyRow&)> text;  // nothing: the word of the cell, to the left
};

const std::vector<Column>& own_columns() {
  using Row = const StudyRow&;
  static const std::vector<Column> columns{
      {"quantity", "quantity", [](Row row) { return cell(row.quantity); }, {}},
      {"place", "place", [](Row row) { return cell(row.place); }, {}},
      {"srif_method", "method", [](Row row) { return cell(row.method); }, {}},
      {"computed", "computed", [](Row row) { return cell(row.computed); },
       [](Row row) { return shown("{:.6g}", row.computed); }},
      {"reference", "reference", [](Row row) { return cell(row.reference); },
       [](Row row) { return shown("{:.6g}", row.reference); }},
      {"error", "error %", [](Row row) { return cell(row.error()); },
       [](Row row) { return row.error() ? fmt::format("{:+.3f}", 100 * *row.error()) : ""; }},
      {"estimated_error", "estimated %", [](Row row) { return cell(row.estimated_error()); },
       [](Row row) { return row.estimated_error() ? fmt::format("{:.2g}", 100 * *row.estimated_error()) : ""; }},
      {"points", "points", [](Row row) { return cell(row.points); }, [](Row row) { return shown("{}", row.points); }},
      {"spacing", "spacing", [](Row row) { return cell(row.spacing); },
       [](Row row) { return shown("{:.5g}", row.spacing); }},
      {"horizon", "horizon", [](Row row) { return cell(row.horizon); },
       [](Row row) { return shown("{:.5g}", row.horizon); }},
      {"iterations", "iterations", [](Row row) { return cell(row.iterations); },
       [](Row row) { return shown("{}", row.iterations); }},
      {"seconds", "seconds", [](Row row) { return cell(row.seconds); },
       [](Row row) { return shown("{:.2f}", row.seconds); }},
      {"solve_seconds", "solve", [](Row row) { return cell(row.solve_seconds); },
       [](Row row) { return shown("{:.2f}", row.solve_seconds); }},
      {"seconds_min", nullptr, [](Row row) { return cell(row.seconds_min); }, {}},
      {"seconds_max", nullptr, [](Row row) { return cell(row.seconds_max); }, {}},
      {"geometry_seconds", nullptr, [](Row row) { return cell_of(row, "geometry"); }, {}},
      {"families_seconds", nullptr, [](Row row) { return cell_of(row, "families"); }, {}},
      {"parameters_seconds", nullptr, [](Row row) { return cell_of(row, "parameters"); }, {}},
      {"srif_seconds", nullptr, [](Row row) { return cell_of(row, "srif"); }, {}},
      {"output_seconds", nullptr, [](Row row) { return cell_of(row, "output"); }, {}},
      {"reference_source", nullptr, [](Row row) { return cell(row.source); }, {}},
      {"outcome", nullptr, [](Row row) { return cell(row.outcome); }, {}},
      {"message", "", [](Row row) { return cell(row.message); }, {}}};
  return columns;
}

/// The study's own columns, without those that an axis stands for.
std::vector<Column> columns_beside(const std::vector<std::string>& axes) {
  auto result = own_columns();
  std::erase_if(result, [&](const Column& c) { return std::ranges::find(axes, c.name) != axes.end(); });
  return result;
}

/// What no row has is not printed of what only some studies have.
bool is_wanted_in_text(const StudyTable& study, const Column& column) {
  if (!column.title) return false;
  const std::string name = column.name;
  if (name != "srif_method" && name != "reference" && name != "error" && name != "estimated_error") return true;
  return std::ranges::any_of(study.rows, [&](const StudyRow& row) { return column.cell(row) != Cell(); });
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

Table table(const StudyTable& study) {
  const auto own = columns_beside(study.axes);
  Table result{study.axes, {}};
  for (const auto& column : own) result.columns.emplace_back(column.name);
  for (const auto& row : study.rows) {
    std::vector<Cell> cells(row.labels.begin(), row.labels.end());
    for (const auto& column : own) cells.push_back(column.cell(row));
    result.rows.push_back(std::move(cells));
  }
  return result;
}

std::string costs_text(const StudyTable& study) {
  constexpr std::array stages{"geometry", "families", "parameters", "solve", "srif", "output"};
  std::vector<TextColumn> columns;
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
  return aligned(columns);
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
  if (!row.message.empty()) parts.push_back(one_line(row.message));
  return fmt::format("{}{}{}", fmt::join(row.labels, ", "), row.labels.empty() ? "" : ": ", fmt::join(parts, ", "));
}

std::string to_text(const StudyTable& study) {
  std::vector<TextColumn> columns;
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
        const Cell found = column.cell(row);
        return one_line(std::holds_alternative<std::string>(found) ? std::get<std::string>(found) : "");
      });
  }
  return aligned(columns);
}

}  // namespace post
