#include "post/report/curve_plot.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "post/files/table.hpp"

namespace post {
namespace {

// The page [px]; a panel is its legend, its plot and, where they are shown, the labels of t.
constexpr double page_width = 900, left = 86, right = 28, top = 64, bottom = 14;
constexpr double plot_width = page_width - left - right;
constexpr double legend_line = 20, legend_gap = 10, labels_height = 50, panel_gap = 22;
constexpr double character = 6.6, sample_width = 30, entry_gap = 24;  // of the legend; 12 px type is 6 to 7 px wide

const char* class_of(Line line) {
  static const std::map<Line, const char*> names{{Line::reference, "reference"},
                                                 {Line::second_reference, "second"},
                                                 {Line::third_reference, "third"},
                                                 {Line::computed, "computed"}};
  const auto found = names.find(line);
  return found == names.end() ? "numbered" : found->second;
}

bool has_marks(const Series& series) {
  return series.line == Line::numbered || series.line == Line::marks || series.line == Line::rings;
}

bool is_joined(const Series& series) {
  return series.line != Line::marks && series.line != Line::rings;
}

bool drawable(double value) {
  return std::abs(value) < 1e300;
}  // the width of a range must stay finite; false for NaN

bool drawable(const Curve& curve, std::size_t i) {
  return drawable(curve.t[i]) && drawable(curve.y[i]);
}

bool drawable(const Panel& panel, const Curve& curve, std::size_t i) {
  const auto shown = [](Scale scale, double value) { return scale == Scale::linear || value > 1e-300; };
  return drawable(curve, i) && shown(panel.t_scale, curve.t[i]) && shown(panel.y_scale, curve.y[i]);
}

/// The range of t or y over all series; one with some width also where there are no values or all are the same.
Range range(const Panel& panel, std::vector<double> Curve::*values, Scale scale = Scale::linear) {
  std::optional<Range> found;
  for (const Series& series : panel.series) {
    for (std::size_t i = 0; i < series.curve.t.size(); ++i) {
      if (!drawable(panel, series.curve, i)) continue;
      const double value = (series.curve.*values)[i];
      found = found ? Range{std::min(found->low, value), std::max(found->high, value)} : Range{value, value};
    }
  }
  if (!found) return {scale == Scale::linear ? 0.0 : 0.1, 1};
  const double size = std::max(std::abs(found->low), std::abs(found->high));
  const bool has_width = found->high - found->low > 1e-9 * size;
  if (scale == Scale::logarithmic) return has_width ? *found : Range{found->low / 2, found->high * 2};
  if (size < 1e-290) return {-1, 1};  // powers of ten below the least normal number lose their digits
  if (has_width) return *found;
  return {found->low - size / 2, found->high + size / 2};
}

/// The range with room for the marks at its ends.
Range widened(const Range& r, Scale scale) {
  constexpr double room = 0.05;
  if (scale == Scale::linear) return {r.low - room * (r.high - r.low), r.high + room * (r.high - r.low)};
  const double factor = std::pow(r.high / r.low, room);
  return {r.low / factor, r.high * factor};
}

bool has_marks(const Panel& panel) {
  return std::ranges::any_of(panel.series, [](const Series& series) { return has_marks(series); });
}

PlotAxis t_axis(const Panel& panel) {
  const Range found = panel.t_range.value_or(range(panel, &Curve::t, panel.t_scale));
  return plot_axis(has_marks(panel) ? widened(found, panel.t_scale) : found, panel.t_scale, 10, false);
}

PlotAxis y_axis(const Panel& panel) {
  const Range found = range(panel, &Curve::y, panel.y_scale);
  const bool marks = has_marks(panel);
  const int count = static_cast<int>(panel.height / 43);  // a label every 43 px
  return plot_axis(marks ? widened(found, panel.y_scale) : found, panel.y_scale, count, !marks);
}

struct PanelLayout {
  PlotAxis t, y;
  double height = 0;  // of the plot
  bool shows_t = true;
  std::vector<std::pair<double, double>> legend;  // where each entry begins, from the left and the top of the panel
  double from = 0, plot = 0;                      // top of the panel and of its plot

  double x_of(double value) const { return left + plot_width * t.share(value); }
  double y_of(double value) const { return plot + height * (1 - y.share(value)); }
  double floor() const { return plot + height; }
  double end() const { return floor() + (shows_t ? labels_height : 0); }
};

PanelLayout panel_layout(const Panel& panel, double from) {
  PanelLayout result;
  result.t = t_axis(panel);
  result.y = y_axis(panel);
  result.height = panel.height;
  double x = 0, y = 0;
  for (const Series& series : panel.series) {
    if (series.label.empty()) {
      result.legend.emplace_back(0, 0);
      continue;
    }
    const double width = sample_width + 8 + character * static_cast<double>(characters(series.label));
    if (x > 0 && x + width > plot_width) {
      x = 0;
      y += legend_line;
    }
    result.legend.emplace_back(x, y);
    x += width + entry_gap;
  }
  result.from = from;
  result.plot = from + y + (x == 0 ? 0 : legend_line) + legend_gap;
  return result;
}

std::vector<PanelLayout> panel_layout(const std::vector<Panel>& panels) {
  std::vector<PanelLayout> result;
  double from = top;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    result.push_back(panel_layout(panels[i], from));
    const bool is_last = i + 1 == panels.size();
    result[i].shows_t = is_last || panels[i + 1].t_title != panels[i].t_title ||
                        panels[i + 1].t_scale != panels[i].t_scale || t_axis(panels[i + 1]).range != result[i].t.range;
    from = result[i].end() + panel_gap;
  }
  return result;
}

std::string axes(const Panel& panel, const PanelLayout& at) {
  std::string text;
  for (const auto& [value, label] : at.t.ticks) {
    const double x = at.x_of(value);
    text += svg::line(x, at.plot, x, at.floor(), label.empty() ? "minor" : "grid");
    if (at.shows_t && !label.empty())
      text += fmt::format("  <text class=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x, at.floor() + 18, label);
  }
  const auto& y_ticks = at.y.ticks;
  const bool is_linear = at.y.scale == Scale::linear;
  const double step = y_ticks.size() > 1 ? y_ticks[1].value - y_ticks[0].value : 0;
  for (const auto& [value, label] : y_ticks) {
    const bool is_zero = is_linear && std::abs(value) < 1e-6 * step;
    const double y = at.y_of(value);
    text += svg::line(left, y, left + plot_width, y, is_zero ? "zero" : label.empty() ? "minor" : "grid");
    if (!label.empty())
      text += fmt::format("  <text class=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", left - 9, y + 4.2, label);
  }
  if (at.shows_t)
    text += fmt::format("  <text class=\"axis middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", left + plot_width / 2,
                        at.floor() + 41, axis_title(panel.t_title, at.t));
  text += fmt::format("  <text class=\"axis middle\" transform=\"translate(24 {:.1f}) rotate(-90)\">{}</text>\n",
                      at.plot + at.height / 2, axis_title(panel.y_title, at.y));
  return text;
}

/// The class of a curve's line, and its colour where it is one of many.
std::string stroke(const Series& series) {
  const std::string kind = fmt::format("class=\"curve {}\"", class_of(series.line));
  return series.line == Line::plain || series.line == Line::numbered ? kind + " " + svg::Look(series.number).stroke()
                                                                     : kind;
}

std::string mark(const Series& series, double x, double y) {
  return series.line == Line::rings ? svg::ring(x, y) : svg::mark(x, y, svg::Look(series.number));
}

std::string path(const Panel& panel, const Series& series, const PanelLayout& at) {
  const Curve curve = thinned(series.curve, static_cast<std::size_t>(plot_width));
  std::string points, marks;
  bool joined = false;
  for (std::size_t i = 0; i < curve.t.size(); ++i) {
    const bool drawn = drawable(panel, curve, i);
    if (drawn) {
      const double x = at.x_of(curve.t[i]), y = at.y_of(curve.y[i]);
      points += fmt::format("{}{:.2f} {:.2f}", joined ? 'L' : 'M', x, y);
      if (has_marks(series)) marks += mark(series, x, y);
    }
    joined = drawn;
  }
  if (points.empty()) return "";
  if (!is_joined(series)) return marks;
  return fmt::format("  <path {} d=\"{}\"/>\n", stroke(series), points) + marks;
}

std::string legend_entry(const Series& series, double x, double y) {
  std::string text;
  if (is_joined(series))
    text += fmt::format("  <path {} d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n", stroke(series), x + 2, y,
                        x + sample_width - 2, y);
  if (has_marks(series)) text += mark(series, x + sample_width / 2, y);
  return text + fmt::format("  <text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x + sample_width + 8, y + 4.2,
                            escaped(series.label));
}

std::string drawn(const Panel& panel, const PanelLayout& at) {
  std::string text = axes(panel, at);
  for (const Series& series : panel.series) text += path(panel, series, at);
  text += fmt::format("  <rect class=\"frame\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n", left,
                      at.plot, plot_width, at.height);
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    if (panel.series[i].label.empty()) continue;
    const auto& [x, y] = at.legend[i];
    text += legend_entry(panel.series[i], left + x, at.from + y + legend_line / 2);
  }
  return text;
}

/// The samples [from, to) of one strip: the least and the greatest, in their order; one gap where nothing is finite.
void add_extremes(Curve& result, const Curve& curve, std::size_t from, std::size_t to) {
  std::optional<std::size_t> least, greatest;
  for (std::size_t i = from; i < to; ++i) {
    if (!drawable(curve, i)) continue;
    if (!least || curve.y[i] < curve.y[*least]) least = i;
    if (!greatest || curve.y[i] > curve.y[*greatest]) greatest = i;
  }
  const auto add = [&](std::size_t i) {
    result.t.push_back(curve.t[i]);
    result.y.push_back(curve.y[i]);
  };
  if (!least) return add(from);
  add(std::min(*least, *greatest));
  if (*least != *greatest) add(std::max(*least, *greatest));
}

}  // namespace

std::string to_svg(const CurvePlot& plot) {
  const std::vector<PanelLayout> at = panel_layout(plot.panels);
  const double height = (at.empty() ? top : at.back().end()) + bottom;
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "role=\"img\">\n  <title>{2}</title>\n{3}  <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
      "  <text class=\"title\" x=\"{4:.0f}\" y=\"36\">{2}</text>\n",
      page_width, height, escaped(plot.title), svg::style(), left);
  for (std::size_t i = 0; i < at.size(); ++i) text += drawn(plot.panels[i], at[i]);
  return text + "</svg>\n";
}

Curve thinned(const Curve& curve, std::size_t columns, std::size_t enough) {
  const std::size_t count = curve.t.size();
  if (count <= enough || columns == 0) return curve;
  const Panel alone{"", "", {{"", Line::computed, curve}}};
  const Range span = range(alone, &Curve::t);
  const auto column = [&](std::size_t i) {
    const double share = drawable(curve.t[i]) ? (curve.t[i] - span.low) / (span.high - span.low) : 0;
    return std::min(columns - 1, static_cast<std::size_t>(share * static_cast<double>(columns)));
  };
  Curve result{{curve.t.front()}, {curve.y.front()}};
  for (std::size_t from = 1; from + 1 < count;) {
    std::size_t to = from + 1;
    while (to + 1 < count && column(to) == column(from)) ++to;
    add_extremes(result, curve, from, to);
    from = to;
  }
  result.t.push_back(curve.t.back());
  result.y.push_back(curve.y.back());
  return result;
}

}  // namespace post
