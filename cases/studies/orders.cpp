#include "cases/studies/orders.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>

#include "cases/studies/ledger.hpp"
#include "post/files/table.hpp"

namespace cases {
namespace {

constexpr std::size_t least_runs = 3;  // two errors lie on a line whatever they are

std::vector<std::string> without(std::vector<std::string> labels, std::optional<std::size_t> axis) {
  if (axis) labels.erase(labels.begin() + std::ptrdiff_t(*axis));
  return labels;
}

/// True where a pair of rows has labels that differ on this axis alone and lengths that differ.
bool changes(const std::vector<StudyRow>& rows, std::size_t axis, std::optional<double> StudyRow::*length) {
  std::map<std::vector<std::string>, double> first;  // the length of the first row with these labels on the other axes
  for (const StudyRow& row : rows) {
    if (!(row.*length)) continue;
    const double found = *(row.*length);
    const double known = first.emplace(without(row.labels, axis), found).first->second;
    if (std::abs(found - known) > 1e-9 * std::max(found, known)) return true;
  }
  return false;
}

/// log10 of lengths, of seconds and of errors, for the rows of a line that have an error other than zero.
struct Logarithms {
  std::vector<double> length, seconds, error;
};

Logarithms logarithms(const StudyTable& study, const StudyLine& line, const Refinement& along) {
  Logarithms result;
  for (const std::size_t i : line.rows) {
    const StudyRow& row = study.rows[i];
    const auto length = along.length(row), error = row.error();
    if (!length || !row.seconds || !error || *error == 0 || !std::isfinite(*error)) continue;
    result.length.push_back(std::log10(*length));
    result.seconds.push_back(std::log10(std::max(*row.seconds, 1e-6)));  // of the clock: a microsecond
    result.error.push_back(std::log10(std::abs(*error)));
  }
  return result;
}

std::string cell_text(const post::Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return fmt::format("{:.4g}", *number);
  return std::holds_alternative<std::string>(cell) ? std::get<std::string>(cell) : "";
}

}  // namespace

std::optional<Refinement> refinement(const std::vector<StudyRow>& rows) {
  const std::size_t axes = rows.empty() ? 0 : rows.front().labels.size();
  for (std::size_t axis = 0; axis < axes; ++axis)
    if (changes(rows, axis, &StudyRow::spacing)) return Refinement{axis, false};
  for (std::size_t axis = 0; axis < axes; ++axis)
    if (changes(rows, axis, &StudyRow::horizon)) return Refinement{axis, true};
  return std::nullopt;
}

std::vector<StudyLine> lines(const std::vector<StudyRow>& rows, std::optional<std::size_t> axis) {
  std::vector<StudyLine> result;
  std::map<std::vector<std::string>, std::size_t> known;  // what a line is told apart by -> its index
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const StudyRow& row = rows[i];
    if (row.quantity.empty()) continue;
    auto key = without(row.labels, axis);
    for (const auto& word : {row.quantity, row.place, row.method}) key.push_back(word);
    if (!axis) key.push_back(std::to_string(i));
    const auto [line, is_new] = known.emplace(std::move(key), result.size());
    if (is_new) result.push_back({row, {}});
    result[line->second].rows.push_back(i);
  }
  return result;
}

namespace {

/// True where a run is to be made that may be finer than this row, of the same labels but along the refinement.
bool lacks_finer(const StudyTable& study, const StudyRow& finest, std::size_t along) {
  return std::ranges::any_of(study.rows, [&](const StudyRow& row) {
    return row.outcome == RunOutcome::missing && row.spacing && *row.spacing <= *finest.spacing &&
           without(row.labels, along) == without(finest.labels, along);
  });
}

}  // namespace

void refer_to_finest(StudyTable& study) {
  const auto along = refinement(study.rows);
  if (!along || along->by_horizon) return;
  const auto is_finer = [&](std::size_t i, std::size_t j) {
    const StudyRow &one = study.rows[i], &other = study.rows[j];
    if (one.spacing != other.spacing) return *one.spacing < *other.spacing;
    return one.points.value_or(0) > other.points.value_or(0);
  };
  for (const auto& line : lines(study.rows, along->axis)) {
    auto candidates = line.rows;
    std::erase_if(candidates, [&](std::size_t i) {
      const StudyRow& row = study.rows[i];
      return !row.against_finest || !row.computed || !row.spacing;
    });
    if (candidates.empty()) continue;
    const std::size_t finest = *std::ranges::min_element(candidates, is_finer);
    const bool is_missing = lacks_finer(study, study.rows[finest], along->axis);
    for (const std::size_t i : candidates) {
      if (is_missing) {
        study.rows[i].reference.reset();
        study.rows[i].source = "the finest is missing";
        continue;
      }
      study.rows[i].reference = i == finest ? std::nullopt : study.rows[finest].computed;
      study.rows[i].source = i == finest ? "this is the finest" : "finest: " + study.rows[finest].labels[along->axis];
    }
  }
}

std::vector<Order> orders(const StudyTable& study) {
  std::vector<Order> result;
  const auto along = refinement(study.rows);
  if (!along) return result;
  for (const auto& line : lines(study.rows, along->axis)) {
    const auto logs = logarithms(study, line, *along);
    const auto in_length = slope(logs.length, logs.error), in_seconds = slope(logs.seconds, logs.error);
    if (!in_length) continue;
    Order one{line.first, logs.error.size(), std::nullopt, std::nullopt, std::nullopt};
    if (one.runs >= least_runs) {
      one.order = in_length->slope, one.misfit = in_length->misfit;
      if (in_seconds) one.seconds = in_seconds->slope;
    }
    result.push_back(std::move(one));
  }
  return result;
}

const std::vector<std::string>& order_columns() {
  static const std::vector<std::string> names{"quantity", "place", "srif_method", "against",
                                              "runs",     "order", "misfit",      "seconds_slope"};
  return names;
}

post::Table orders_table(const StudyTable& study) {
  const auto along = refinement(study.rows);
  post::Table result;
  if (along) result.columns = without(study.axes, along->axis);
  result.columns.insert(result.columns.end(), order_columns().begin(), order_columns().end());
  for (const auto& [line, runs, order, misfit, seconds] : orders(study)) {
    const auto labels = without(line.labels, along->axis);
    std::vector<post::Cell> cells(labels.begin(), labels.end());
    for (post::Cell value :
         {post::cell(line.quantity), post::cell(line.place), post::cell(line.method),
          post::Cell(along->by_horizon ? "horizon" : "spacing"), post::Cell(static_cast<double>(runs)),
          post::cell(order), post::cell(misfit), post::cell(seconds)})
      cells.push_back(std::move(value));
    result.rows.push_back(std::move(cells));
  }
  return result;
}

std::string orders_text(const StudyTable& study) {
  const post::Table table = orders_table(study);
  const auto numbers = std::ranges::find(table.columns, "runs") - table.columns.begin();
  std::vector<post::TextColumn> columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    columns.push_back({table.columns[i], std::ptrdiff_t(i) >= numbers, {}});
    for (const auto& row : table.rows) columns.back().cells.push_back(cell_text(row[i]));
    const bool is_empty = std::ranges::all_of(columns.back().cells, &std::string::empty);
    if (is_empty) columns.pop_back();
  }
  return post::aligned(columns);
}

std::optional<Slope> slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto count = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / count;
    mean_y += y[i] / count;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
    yy += (y[i] - mean_y) * (y[i] - mean_y);
  }
  if (x.size() < 2 || xx < 1e-18 * count) return std::nullopt;
  return Slope{xy / xx, std::sqrt(std::max(0.0, yy - xy * xy / xx) / count)};
}

}  // namespace cases
