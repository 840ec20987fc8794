#include "post/curve_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>

namespace post {
namespace {

// The page [px]; a panel is its legend, its plot and, where they are shown, the labels of t.
constexpr double page_width = 900, left = 86, right = 28, top = 64, bottom = 14;
constexpr double plot_width = page_width - left - right, plot_height = 216;
constexpr double legend_line = 20, legend_gap = 10, labels_height = 50, panel_gap = 22;
constexpr double character = 6.6, sample_width = 30, entry_gap = 24;  // of the legend; 12 px type is 6 to 7 px wide

constexpr const char* style = R"(  <style>
    text { font-family: "Helvetica Neue", Helvetica, Arial, "Liberation Sans", "DejaVu Sans", sans-serif; font-size: 12px; fill: #333 }
    .title { font-size: 17px; font-weight: 600; fill: #111 }
    .axis { font-size: 13px; fill: #111 }
    .power { font-size: 10px }
    .middle { text-anchor: middle }
    .end { text-anchor: end }
    .grid { stroke: #e6e6e6; stroke-width: 1; fill: none }
    .zero { stroke: #b0b0b0; stroke-width: 1; fill: none }
    .frame { stroke: #444; stroke-width: 1; fill: none }
    .curve { fill: none; stroke-linejoin: round }
    .reference { stroke: #bdbdbd; stroke-width: 5 }
    .second { stroke: #5c5c5c; stroke-width: 1.6; stroke-dasharray: 8 4 }
    .third { stroke: #5c5c5c; stroke-width: 1.6; stroke-dasharray: 1.6 3.2 }
    .computed { stroke: #c2410c; stroke-width: 1.5 }
  </style>
)";

const char* class_of(Line line) {
  switch (line) {
    case Line::reference:
      return "reference";
    case Line::second_reference:
      return "second";
    case Line::third_reference:
      return "third";
    case Line::computed:
      break;
  }
  return "computed";
}

struct Range {
  double low = 0, high = 1;
  bool operator==(const Range&) const = default;
};

bool drawable(double value) {
  return std::abs(value) < 1e300;
}  // the width of a range must stay finite; false for NaN

bool drawable(const Curve& curve, std::size_t i) {
  return drawable(curve.t[i]) && drawable(curve.y[i]);
}

/// The range of t or y over all series; one with some width also where there are no values or all are the same.
Range range(const Panel& panel, std::vector<double> Curve::*values) {
  std::optional<Range> found;
  for (const Series& series : panel.series) {
    for (std::size_t i = 0; i < series.curve.t.size(); ++i) {
      if (!drawable(series.curve, i)) continue;
      const double value = (series.curve.*values)[i];
      found = found ? Range{std::min(found->low, value), std::max(found->high, value)} : Range{value, value};
    }
  }
  if (!found) return {};
  const double size = std::max(std::abs(found->low), std::abs(found->high));
  if (size < 1e-290) return {-1, 1};  // powers of ten below the least normal number lose their digits
  if (found->high - found->low > 1e-9 * size) return *found;
  return {found->low - size / 2, found->high + size / 2};
}

/// A range with its ticks, those of y covering it, and the power of ten that the labels leave out.
struct Axis {
  Range range;
  std::vector<double> at;
  int power = 0, decimals = 0;

  double share(double value) const { return (value - range.low) / (range.high - range.low); }
};

Axis axis(const Range& range, int count, bool covers) {
  Axis result{range, ticks(range.low, range.high, count)};
  const double step = result.at[1] - result.at[0];
  if (covers) {
    result.range = {result.at.front(), result.at.back()};
  } else {
    std::erase_if(result.at,
                  [&](double tick) { return tick < range.low - 1e-9 * step || tick > range.high + 1e-9 * step; });
  }
  const double size = std::max(std::abs(result.range.low), std::abs(result.range.high));
  if (size < 0.05 || size >= 1e4) result.power = 3 * static_cast<int>(std::floor(std::log10(size) / 3));
  result.decimals = std::max(0, result.power - static_cast<int>(std::floor(std::log10(step) + 1e-6)));
  return result;
}

/// A number in digits with a true minus sign.
std::string digits(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool is_zero = text.find_first_not_of("0.") == std::string::npos;
  return fmt::format("{}{}", value < 0 && !is_zero ? "\u2212" : "", text);
}

std::string label(const Axis& axis, double tick) {
  // 10^-power may be beyond the largest number where 10^power is not
  const double scaled = axis.power < 0 ? tick * std::pow(10.0, -axis.power) : tick / std::pow(10.0, axis.power);
  return digits(scaled, axis.decimals);
}

std::string title(const std::string& name, const Axis& axis) {
  if (axis.power == 0) return escaped(name);
  return fmt::format("{} (\u00d7\u200910<tspan class=\"power\" dy=\"-5\">{}</tspan><tspan dy=\"5\">)</tspan>",
                     escaped(name), digits(axis.power, 0));
}

struct Laid {
  Axis t, y;
  bool shows_t = true;
  std::vector<std::pair<double, double>> legend;  // where each entry begins, from the left and the top of the panel
  double from = 0, plot = 0;                      // top of the panel and of its plot

  double x_of(double value) const { return left + plot_width * t.share(value); }
  double y_of(double value) const { return plot + plot_height * (1 - y.share(value)); }
  double floor() const { return plot + plot_height; }
  double end() const { return floor() + (shows_t ? labels_height : 0); }
};

std::size_t characters(const std::string& utf8) {
  return static_cast<std::size_t>(
      std::ranges::count_if(utf8, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

Laid laid(const Panel& panel, double from) {
  Laid result;
  result.t = axis(range(panel, &Curve::t), 10, false);
  result.y = axis(range(panel, &Curve::y), 5, true);
  double x = 0, y = 0;
  for (const Series& series : panel.series) {
    const double width = sample_width + 8 + character * static_cast<double>(characters(series.label));
    if (x > 0 && x + width > plot_width) {
      x = 0;
      y += legend_line;
    }
    result.legend.emplace_back(x, y);
    x += width + entry_gap;
  }
  result.from = from;
  result.plot = from + y + (panel.series.empty() ? 0 : legend_line) + legend_gap;
  return result;
}

std::vector<Laid> laid(const std::vector<Panel>& panels) {
  std::vector<Laid> result;
  double from = top;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    result.push_back(laid(panels[i], from));
    const bool is_last = i + 1 == panels.size();
    result[i].shows_t = is_last || panels[i + 1].t_title != panels[i].t_title ||
                        range(panels[i + 1], &Curve::t) != range(panels[i], &Curve::t);
    from = result[i].end() + panel_gap;
  }
  return result;
}

std::string line(double x1, double y1, double x2, double y2, const char* kind) {
  return fmt::format("  <path class=\"{}\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n", kind, x1, y1, x2, y2);
}

std::string axes(const Panel& panel, const Laid& at) {
  std::string text;
  for (const double tick : at.t.at) {
    text += line(at.x_of(tick), at.plot, at.x_of(tick), at.floor(), "grid");
    if (at.shows_t)
      text += fmt::format("  <text class=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", at.x_of(tick),
                          at.floor() + 18, label(at.t, tick));
  }
  const double step = at.y.at[1] - at.y.at[0];
  for (const double tick : at.y.at) {
    const bool is_zero = std::abs(tick) < 1e-6 * step;
    text += line(left, at.y_of(tick), left + plot_width, at.y_of(tick), is_zero ? "zero" : "grid");
    text += fmt::format("  <text class=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", left - 9, at.y_of(tick) + 4.2,
                        label(at.y, tick));
  }
  if (at.shows_t)
    text += fmt::format("  <text class=\"axis middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", left + plot_width / 2,
                        at.floor() + 41, title(panel.t_title, at.t));
  text += fmt::format("  <text class=\"axis middle\" transform=\"translate(24 {:.1f}) rotate(-90)\">{}</text>\n",
                      at.plot + plot_height / 2, title(panel.y_title, at.y));
  return text;
}

std::string path(const Series& series, const Laid& at) {
  const Curve curve = thinned(series.curve, static_cast<std::size_t>(plot_width));
  std::string points;
  bool joined = false;
  for (std::size_t i = 0; i < curve.t.size(); ++i) {
    const bool drawn = drawable(curve, i);
    if (drawn) points += fmt::format("{}{:.2f} {:.2f}", joined ? 'L' : 'M', at.x_of(curve.t[i]), at.y_of(curve.y[i]));
    joined = drawn;
  }
  if (points.empty()) return "";
  return fmt::format("  <path class=\"curve {}\" d=\"{}\"/>\n", class_of(series.line), points);
}

std::string drawn(const Panel& panel, const Laid& at) {
  std::string text = axes(panel, at);
  for (const Series& series : panel.series) text += path(series, at);
  text += fmt::format("  <rect class=\"frame\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n", left,
                      at.plot, plot_width, plot_height);
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    const double x = left + at.legend[i].first, y = at.from + at.legend[i].second + legend_line / 2;
    const std::string kind = fmt::format("curve {}", class_of(panel.series[i].line));
    text += line(x + 2, y, x + sample_width - 2, y, kind.c_str());
    text += fmt::format("  <text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x + sample_width + 8, y + 4.2,
                        escaped(panel.series[i].label));
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
  const std::vector<Laid> at = laid(plot.panels);
  const double height = (at.empty() ? top : at.back().end()) + bottom;
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "role=\"img\">\n  <title>{2}</title>\n{3}  <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
      "  <text class=\"title\" x=\"{4:.0f}\" y=\"36\">{2}</text>\n",
      page_width, height, escaped(plot.title), style, left);
  for (std::size_t i = 0; i < at.size(); ++i) text += drawn(plot.panels[i], at[i]);
  return text + "</svg>\n";
}

std::vector<double> ticks(double low, double high, int count) {
  if (!(low < high) || !std::isfinite(high - low) || count < 1)
    throw std::invalid_argument(fmt::format("no ticks from {} to {}", low, high));
  const double raw = (high - low) / count, power = std::pow(10.0, std::floor(std::log10(raw)));
  const double multiple = raw / power;
  const double step = power * (multiple <= 1.0001 ? 1 : multiple <= 2.0001 ? 2 : multiple <= 5.0001 ? 5 : 10);
  std::vector<double> result;
  for (double k = std::floor(low / step + 1e-9), last = std::ceil(high / step - 1e-9); k <= last; ++k)
    result.push_back(k * step + 0.0);  // + 0.0: no negative zero
  return result;
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

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20 || c == '\t' || c == '\n') result += c;
    }
  }
  return result;
}

}  // namespace post
