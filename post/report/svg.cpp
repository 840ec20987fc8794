#include "post/report/svg.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

namespace post::svg {

std::string style() {
  return R"(  <style>
    text { font-family: "Helvetica Neue", Helvetica, Arial, "Liberation Sans", "DejaVu Sans", sans-serif; font-size: 12px; fill: #333 }
    .title { font-size: 17px; font-weight: 600; fill: #111 }
    .axis { font-size: 13px; fill: #111 }
    .power { font-size: 10px }
    .middle { text-anchor: middle }
    .end { text-anchor: end }
    .grid { stroke: #e6e6e6; stroke-width: 1; fill: none }
    .minor { stroke: #f2f2f2; stroke-width: 1; fill: none }
    .zero { stroke: #b0b0b0; stroke-width: 1; fill: none }
    .frame { stroke: #444; stroke-width: 1; fill: none }
    .curve { fill: none; stroke-linejoin: round }
    .numbered { stroke-width: 1.5 }
    .mark { stroke-width: 1.5; stroke-linejoin: round }
    .ring { fill: none; stroke: #111; stroke-width: 1.4 }
    .reference { stroke: #bdbdbd; stroke-width: 5 }
    .second { stroke: #5c5c5c; stroke-width: 1.6; stroke-dasharray: 8 4 }
    .third { stroke: #5c5c5c; stroke-width: 1.6; stroke-dasharray: 1.6 3.2 }
    .computed { stroke: #c2410c; stroke-width: 1.5 }
  </style>
)";
}

std::string line(double x1, double y1, double x2, double y2, const std::string& kind) {
  return fmt::format("  <path class=\"{}\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n", kind, x1, y1, x2, y2);
}

Look::Look(std::size_t number) {
  constexpr std::array colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};
  constexpr std::array gaps{"", "7 3", "2 3"};
  constexpr std::size_t symbols = 6;
  colour = colours[number % colours.size()];
  symbol = (number + number / colours.size()) % symbols;
  dashes = gaps[number / colours.size() % gaps.size()];
}

std::string Look::stroke() const {
  const std::string gaps = dashes.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", dashes);
  return fmt::format("stroke=\"{}\"{}", colour, gaps);
}

std::string mark(double x, double y, const Look& look) {
  // about the origin, of about the same area
  constexpr std::array shapes{"m-3.8 0a3.8 3.8 0 1 0 7.6 0a3.8 3.8 0 1 0 -7.6 0Z",
                              "m-3.4 -3.4h6.8v6.8h-6.8Z",
                              "m0 -4.8l4.6 7.8h-9.2Z",
                              "m0 -5l4.4 5l-4.4 5l-4.4 -5Z",
                              "m0 4.8l4.6 -7.8h-9.2Z",
                              "m-3.6 -3.6l7.2 7.2m0 -7.2l-7.2 7.2"};
  return fmt::format("  <path class=\"mark\" stroke=\"{0}\" fill=\"{0}\" d=\"M{1:.2f} {2:.2f}{3}\"/>\n", look.colour, x,
                     y, shapes[look.symbol % shapes.size()]);
}

std::string ring(double x, double y) {
  return fmt::format("  <circle class=\"ring\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"6\"/>\n", x, y);
}

}  // namespace post::svg

namespace post {

std::string escaped(const std::string& text) {
  static const std::map<char, const char*> entities{
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}};
  std::string result;
  for (const char c : text)
    if (const auto found = entities.find(c); found != entities.end())
      result += found->second;
    else if (static_cast<unsigned char>(c) >= 0x20 || c == '\t' || c == '\n')
      result += c;
  return result;
}

namespace {

/// A number in digits with a true minus sign.
std::string digits(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool is_zero = text.find_first_not_of("0.") == std::string::npos;
  return fmt::format("{}{}", value < 0 && !is_zero ? "\u2212" : "", text);
}

std::string power_of_ten(int power) {
  return fmt::format("10<tspan class=\"power\" dy=\"-5\">{}</tspan>", digits(power, 0));
}

PlotAxis linear(const Range& range, int count, bool covers) {
  PlotAxis result{Scale::linear, range, {}, 0};
  auto at = ticks(range.low, range.high, count);
  const double step = at[1] - at[0];
  if (covers) {
    result.range = {at.front(), at.back()};
  } else {
    std::erase_if(at, [&](double tick) { return tick < range.low - 1e-9 * step || tick > range.high + 1e-9 * step; });
  }
  const double size = std::max(std::abs(result.range.low), std::abs(result.range.high));
  if (size < 0.05 || size >= 1e4) result.power = 3 * static_cast<int>(std::floor(std::log10(size) / 3));
  const int decimals = std::max(0, result.power - static_cast<int>(std::floor(std::log10(step) + 1e-6)));
  for (const double tick : at) {
    // 10^-power may be beyond the largest number where 10^power is not
    const double scaled = result.power < 0 ? tick * std::pow(10.0, -result.power) : tick / std::pow(10.0, result.power);
    result.ticks.push_back({tick, digits(scaled, decimals)});
  }
  return result;
}

/// 0.001, 20, 10^6 or 2 x 10^6.
std::string logarithmic_label(double value, bool plain) {
  if (plain) return fmt::format("{:g}", value);
  const int power = static_cast<int>(std::floor(std::log10(value) + 1e-9));
  const double factor = std::round(value / std::pow(10.0, power) * 1e3) / 1e3;
  return (factor == 1 ? "" : fmt::format("{:g}\u2009\u00d7\u2009", factor)) + power_of_ten(power);
}

/// True where multiples of a power of ten by this digit are labelled on an axis over so many decades.
bool labelled(int digit, int power, double decades) {
  if (decades > 7) return digit == 1 && power % static_cast<int>(std::ceil(decades / 7)) == 0;
  return digit == 1 || (decades < 2.3 && (digit == 2 || digit == 5));
}

PlotAxis logarithmic(const Range& range) {
  PlotAxis result{Scale::logarithmic, range, {}, 0};
  const double decades = std::log10(range.high) - std::log10(range.low);
  const bool plain = range.low >= 0.999e-3 && range.high < 1.001e5;
  const auto add = [&](double value, bool with_label) {
    const bool inside = value > range.low * (1 - 1e-9) && value < range.high * (1 + 1e-9);
    if (inside) result.ticks.push_back({value, with_label ? logarithmic_label(value, plain) : ""});
  };
  constexpr double few = 0.8;  // decades in which 1, 2, 5 can be fewer than two labels
  if (decades < few) {
    for (const double tick : ticks(range.low, range.high, 6)) add(tick, true);
    return result;
  }
  const int last = static_cast<int>(std::ceil(std::log10(range.high)));
  for (int power = static_cast<int>(std::floor(std::log10(range.low))); power <= last; ++power)
    for (int digit = 1; digit < 10; ++digit)
      if (digit == 1 || decades < 7) add(digit * std::pow(10.0, power), labelled(digit, power, decades));
  return result;
}

}  // namespace

double PlotAxis::share(double value) const {
  if (scale == Scale::linear) return (value - range.low) / (range.high - range.low);
  return std::log(value / range.low) / std::log(range.high / range.low);
}

PlotAxis plot_axis(const Range& range, Scale scale, int count, bool covers) {
  return scale == Scale::linear ? linear(range, count, covers) : logarithmic(range);
}

std::string axis_title(const std::string& name, const PlotAxis& axis) {
  if (axis.power == 0) return escaped(name);
  return fmt::format("{} (\u00d7\u200a{}<tspan dy=\"5\">)</tspan>", escaped(name), power_of_ten(axis.power));
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

}  // namespace post
