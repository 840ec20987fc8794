#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "post/report/svg.hpp"

namespace post {

/// Samples of a curve in the order in which they are joined; a value that is not finite leaves a gap.
struct Curve {
  std::vector<double> t, y;
};

/// A reference is thick grey, dashed or dotted, `computed` thin in colour; `plain` is a line, `numbered` a line with
/// marks, `marks` the marks alone, in the look of the number of the series; `rings` are marks for references, to be
/// drawn about others.
enum class Line { reference, second_reference, third_reference, computed, plain, numbered, marks, rings };

struct Series {
  std::string label;  // of the legend; empty: not in it
  Line line = Line::computed;
  Curve curve;
  std::size_t number = 0;
};

/// Series over one another, the first at the bottom. On a logarithmic scale what is not positive is not drawn.
struct Panel {
  std::string t_title, y_title;
  std::vector<Series> series;
  Scale t_scale = Scale::linear, y_scale = Scale::linear;
  double height = 216;                          // of the plot [px]
  std::optional<Range> t_range = std::nullopt;  // absent: that of the series
};

/// Panels below one another.
struct CurvePlot {
  std::string title;
  std::vector<Panel> panels;
};

/// SVG document that needs nothing beside it: axes, grid, curves, a legend above each panel. Panels with the same range
/// and title of t share the labels of the lowest one.
std::string to_svg(const CurvePlot& plot);

/// Thins a curve to at most two samples, the least and the greatest, for each of `columns` strips of equal width
/// between the ends of t; the first and the last sample stay. Curves of up to `enough` samples are returned as they
/// are.
Curve thinned(const Curve& curve, std::size_t columns, std::size_t enough = 2000);

}  // namespace post
