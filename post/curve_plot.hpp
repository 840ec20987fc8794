#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace post {

/// Samples of a curve in the order in which they are joined; a value that is not finite leaves a gap.
struct Curve {
  std::vector<double> t, y;
};

enum class Line { reference, second_reference, third_reference, computed };  // thick grey, dashed, dotted; thin colour

struct Series {
  std::string label;
  Line line = Line::computed;
  Curve curve;
};

/// Series over one another, the first at the bottom.
struct Panel {
  std::string t_title, y_title;
  std::vector<Series> series;
};

/// Panels below one another.
struct CurvePlot {
  std::string title;
  std::vector<Panel> panels;
};

/// One SVG document that needs nothing beside it: axes, grid, curves, a legend above each panel.
/// Panels with the same range and title of t share the labels of the lowest one.
std::string to_svg(const CurvePlot& plot);

/// Multiples of 1, 2 or 5 times a power of ten, about `count` of them, from at or below `low` to at or above `high`
/// (up to 1e-9 of a step). Throws std::invalid_argument unless low < high, both finite.
std::vector<double> ticks(double low, double high, int count = 5);

/// At most two samples, the least and the greatest, for each of `columns` strips of equal width between the ends of t;
/// the first and the last sample stay. Curves of up to `enough` samples are returned as they are.
Curve thinned(const Curve& curve, std::size_t columns, std::size_t enough = 2000);

/// Text with & < > " ' as entities, and without the control characters that XML forbids.
std::string escaped(const std::string& text);

}  // namespace post
