#include "post/figures/svg.hpp"

#include <fmt/format.h>

#include <array>

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
