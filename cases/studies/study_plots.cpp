#include "cases/studies/study_plots.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <set>
#include <tuple>

#include "cases/studies/orders.hpp"

namespace cases {
namespace {

constexpr double panel_height = 330;  // [px]; two of them and their legends fill a page

using Number = std::function<std::optional<double>(const StudyRow&)>;

/// Quantity on one axis of a plot.
struct Abscissa {
  std::string title;
  Number value;
};

bool is_drawn(const std::optional<double>& number) {
  return number && std::isfinite(*number);
}

/// True where rows have several values of what a line may be told apart by.
bool differs(const std::vector<StudyRow>& rows, const std::function<std::string(const StudyRow&)>& word) {
  return std::ranges::any_of(rows, [&](const StudyRow& row) { return word(row) != word(rows.front()); });
}

/// Legend entry of a line along an axis: the labels of the other axes and the method, as far as there are several.
std::string name_of(const StudyTable& study, const StudyLine& line, std::optional<std::size_t> along) {
  std::vector<std::string> parts;
  for (std::size_t axis = 0; axis < study.axes.size(); ++axis) {
    const std::string& label = line.first.labels[axis];
    if (axis == along || !differs(study.rows, [axis](const StudyRow& row) { return row.labels[axis]; })) continue;
    parts.push_back(number_of(label) ? study.axes[axis] + " " + label : label);
  }
  std::vector<StudyRow> same;  // the quantity at this place, by all methods
  for (const auto& row : study.rows)
    if (row.quantity == line.first.quantity && row.place == line.first.place) same.push_back(row);
  if (differs(same, [](const StudyRow& row) { return row.method; }))
    parts.push_back(line.first.method.empty() ? "first method" : line.first.method);
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// Number of a look by name: lines of the same name look the same in all panels.
using Looks = std::map<std::string, std::size_t>;

std::size_t look_of(const std::string& name, Looks& looks) {
  return looks.emplace(name, looks.size()).first->second;
}

/// A quantity at a place, in the order in which the rows first name them.
std::vector<std::pair<std::string, std::string>> places(const StudyTable& study) {
  std::vector<std::pair<std::string, std::string>> result;
  for (const auto& row : study.rows) {
    const std::pair place(row.quantity, row.place);
    if (!row.quantity.empty() && std::ranges::find(result, place) == result.end()) result.push_back(place);
  }
  return result;
}

std::string at(const std::string& place) {
  return place.empty() ? "" : fmt::format(" at {}", place);
}

/// The samples of a line that can be drawn.
post::Curve curve_of(const StudyTable& study, const StudyLine& line, const Number& t, const Number& y) {
  post::Curve result;
  for (const std::size_t i : line.rows) {
    const auto x = t(study.rows[i]), value = y(study.rows[i]);
    if (!is_drawn(x) || !is_drawn(value)) continue;
    result.t.push_back(*x);
    result.y.push_back(*value);
  }
  return result;
}

/// "order 1.96", where the line has one.
std::string order_of(const std::vector<Order>& all, const StudyLine& line) {
  const auto words = [](const StudyRow& row) { return std::tie(row.labels, row.quantity, row.place, row.method); };
  for (const auto& order : all)
    if (words(order.line) == words(line.first) && order.order) return fmt::format("order {:.2f}", *order.order);
  return "";
}

/// Gives all panels the range of t that their series have together, where that has a width.
void share_t(std::vector<post::Panel>& panels) {
  std::set<double> all;
  for (const auto& panel : panels)
    for (const auto& series : panel.series) all.insert(series.curve.t.begin(), series.curve.t.end());
  if (all.size() < 2 || *all.rbegin() < 1.001 * *all.begin()) return;
  for (auto& panel : panels) panel.t_range = post::Range{*all.begin(), *all.rbegin()};
}

post::CurvePlot error_plot(const StudyTable& study, const StudyTitles& titles, const Abscissa& abscissa) {
  const auto along = refinement(study.rows);
  auto axis = along ? std::optional(along->axis) : std::nullopt;
  if (!axis && !study.axes.empty()) axis = study.axes.size() - 1;
  const auto all_orders = orders(study);
  const auto percent = [](const StudyRow& row) {
    const auto error = row.error();
    return error && *error != 0 ? std::optional(100 * std::abs(*error)) : std::nullopt;
  };
  Looks looks;
  post::CurvePlot plot{titles.title, {}};
  for (const auto& [quantity, place] : places(study)) {
    post::Panel panel{abscissa.title, fmt::format("|error| of {}{} [%]", quantity, at(place)), {}};
    panel.t_scale = panel.y_scale = post::Scale::logarithmic;
    panel.height = panel_height;
    for (const auto& line : lines(study.rows, axis)) {
      if (line.first.quantity != quantity || line.first.place != place) continue;
      const std::string name = name_of(study, line, axis), order = order_of(all_orders, line);
      post::Series series{name, along ? post::Line::numbered : post::Line::marks,
                          curve_of(study, line, abscissa.value, percent), look_of(name, looks)};
      if (!order.empty()) series.label += name.empty() ? order : fmt::format(" ({})", order);
      if (!series.curve.t.empty()) panel.series.push_back(std::move(series));
    }
    if (!panel.series.empty()) plot.panels.push_back(std::move(panel));
  }
  share_t(plot.panels);
  return plot;
}

/// The references of the rows of a panel, each place once.
post::Series references(const std::vector<StudyRow>& rows, const Number& t) {
  std::set<std::pair<double, double>> marks;
  for (const auto& row : rows) {
    const auto x = t(row);
    if (is_drawn(x) && is_drawn(row.reference) && !row.against_finest) marks.emplace(*x, *row.reference);
  }
  post::Series series{"reference", post::Line::rings, {}};
  for (const auto& [x, value] : marks) {
    series.curve.t.push_back(x);
    series.curve.y.push_back(value);
  }
  return series;
}

/// A quantity against an axis whose labels are numbers: a panel for each place. No panels where no line has two runs.
post::CurvePlot value_plot(const StudyTable& study, const StudyTitles& titles, const std::string& quantity,
                           std::size_t axis) {
  const Number label = [axis](const StudyRow& row) { return number_of(row.labels[axis]); };
  const Number computed = [](const StudyRow& row) { return row.computed; };
  const std::string si = post::si_unit(quantity), unit = titles.si && !si.empty() ? fmt::format(" [{}]", si) : "";
  Looks looks;
  post::CurvePlot plot{titles.title, {}};
  for (const auto& [name, place] : places(study)) {
    if (name != quantity) continue;
    std::vector<StudyRow> rows;
    for (const auto& row : study.rows)
      if (row.quantity == name && row.place == place) rows.push_back(row);
    const bool peaks = std::ranges::any_of(rows, [](const StudyRow& row) { return row.rms_error.has_value(); });
    post::Panel panel{titles.axes[axis],
                      fmt::format("{}{}{}{}", peaks ? "peak of " : "", post::described(name), at(place), unit),
                      {}};
    panel.height = panel_height;
    bool has_line = false;
    for (const auto& line : lines(study.rows, axis)) {
      if (line.first.quantity != name || line.first.place != place) continue;
      const std::string legend = name_of(study, line, axis);
      post::Series series{legend.empty() ? "computed" : legend, post::Line::numbered,
                          curve_of(study, line, label, computed), look_of(legend, looks)};
      has_line = has_line || series.curve.t.size() > 1;
      if (!series.curve.t.empty()) panel.series.push_back(std::move(series));
    }
    if (auto known = references(rows, label); !known.curve.t.empty()) panel.series.push_back(std::move(known));
    if (has_line) plot.panels.push_back(std::move(panel));
  }
  return plot;
}

/// Numbers over more than a decade and a bit are shown on a logarithmic scale.
post::Scale scale_of(const std::vector<double>& numbers) {
  const auto [low, high] = std::ranges::minmax(numbers);
  return low > 0 && high > 20 * low ? post::Scale::logarithmic : post::Scale::linear;
}

/// The different numbers of an axis; none where a label is no number.
std::vector<double> numbers_of(const StudyTable& study, std::size_t axis) {
  std::set<double> numbers;
  for (const auto& row : study.rows) {
    const auto number = number_of(row.labels[axis]);
    if (!number) return {};
    numbers.insert(*number);
  }
  return {numbers.begin(), numbers.end()};
}

std::size_t numbers_of_points(const StudyTable& study) {
  std::set<std::size_t> numbers;
  for (const auto& row : study.rows)
    if (row.points && !row.stage_seconds.empty()) numbers.insert(*row.points);
  return numbers.size();
}

/// Seconds over points: the whole run with its spread, and its stages.
post::CurvePlot cost_plot(const StudyTable& study, const StudyTitles& titles) {
  post::CurvePlot plot{titles.title, {}};
  post::Panel panel{"points of the plate", "run time [s]", {}};
  panel.t_scale = panel.y_scale = post::Scale::logarithmic;
  panel.height = panel_height;
  const auto add = [&](const std::string& name, post::Line line, const Number& seconds) {
    std::set<std::pair<double, double>> samples;
    for (const auto& row : study.rows)
      if (const auto spent = seconds(row); row.points && is_drawn(spent) && *spent > 0)
        samples.emplace(double(*row.points), *spent);
    post::Series series{name, line, {}, panel.series.size()};
    for (const auto& [points, spent] : samples) series.curve.t.push_back(points), series.curve.y.push_back(spent);
    if (!series.curve.t.empty()) panel.series.push_back(std::move(series));
  };
  add("total", post::Line::marks, [](const StudyRow& row) { return row.seconds; });
  add("shortest", post::Line::marks, [](const StudyRow& row) { return row.seconds_min; });
  add("longest", post::Line::marks, [](const StudyRow& row) { return row.seconds_max; });
  for (const std::string stage : {"geometry", "families", "parameters", "solve", "srif", "output"})
    add(stage, post::Line::marks, [stage](const StudyRow& row) { return std::optional(row.seconds_of(stage)); });
  if (!panel.series.empty() && numbers_of_points(study) > 1) plot.panels.push_back(std::move(panel));
  return plot;
}

}  // namespace

std::map<std::string, post::CurvePlot> study_plots(const StudyTable& study, const StudyTitles& titles) {
  std::map<std::string, post::CurvePlot> plots;
  const auto add = [&](const std::string& name, post::CurvePlot plot) {
    if (!plot.panels.empty()) plots[name + ".svg"] = std::move(plot);
  };
  add("error_against_seconds",
      error_plot(study, titles, {"run time [s]", [](const StudyRow& row) { return row.seconds; }}));
  add("error_against_points", error_plot(study, titles, {"points of the plate", [](const StudyRow& row) {
                                                           return row.points ? std::optional(double(*row.points))
                                                                             : std::nullopt;
                                                         }}));
  add("cost_against_points", cost_plot(study, titles));
  std::set<std::string> quantities;
  for (const auto& place : places(study)) quantities.insert(place.first);
  for (std::size_t axis = 0; axis < study.axes.size(); ++axis) {
    const auto numbers = numbers_of(study, axis);
    if (numbers.size() < 2) continue;
    for (const auto& quantity : quantities) {
      auto plot = value_plot(study, titles, quantity, axis);
      for (auto& panel : plot.panels) panel.t_scale = scale_of(numbers);
      add(plain_name(fmt::format("{}_against_{}", quantity, study.axes[axis])), std::move(plot));
    }
  }
  return plots;
}

std::optional<double> number_of(const std::string& label) {
  double value = 0;
  const char* end = label.data() + label.size();
  const auto [rest, error] = std::from_chars(label.data(), end, value);
  if (label.empty() || rest != end || error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace cases
