#pragma once
#include <cstddef>
#include <string>
#include <vector>

/// Pieces of SVG documents, as text.
namespace post::svg {

/// The style sheet of a plot.
std::string style();

/// A straight line of a class.
std::string line(double x1, double y1, double x2, double y2, const std::string& kind);

/// The look of the lines and marks of one of many series: a colour that the colour-blind can tell from the others
/// (Okabe and Ito, jfly.uni-koeln.de/color), one of six symbols, and dashes. The first 36 differ from each other.
struct Look {
  std::string colour, dashes;  // dashes empty: a line without gaps
  std::size_t symbol = 0;      // circle, square, triangle, diamond, triangle on its tip, cross

  explicit Look(std::size_t number);
  /// The attributes of a path that is a curve.
  std::string stroke() const;
};

/// The symbol of a look around a point.
std::string mark(double x, double y, const Look& look);

/// The black ring of a reference around a point.
std::string ring(double x, double y);

}  // namespace post::svg

namespace post {

/// Text with & < > " ' as entities, and without the control characters that XML forbids.
std::string escaped(const std::string& text);

enum class Scale { linear, logarithmic };

struct Range {
  double low = 0, high = 1;
  bool operator==(const Range&) const = default;
};

/// A tick of an axis; its label is SVG text, empty for a tick between those with labels.
struct Tick {
  double value;
  std::string label;
};

/// A range with its ticks, and the power of ten that the labels leave out.
struct PlotAxis {
  Scale scale = Scale::linear;
  Range range;
  std::vector<Tick> ticks;
  int power = 0;

  /// Position of a value on the axis: 0 at the low end, 1 at the high end.
  double share(double value) const;
};

/// The axis of a range, low < high, both finite, and positive on a logarithmic scale; about `count` labels on a linear
/// one. `covers`: a linear axis begins and ends with a tick, otherwise with the range.
PlotAxis plot_axis(const Range& range, Scale scale, int count, bool covers);

/// Axis title as SVG text: its name, and the power of ten that its labels leave out.
std::string axis_title(const std::string& name, const PlotAxis& axis);

/// Multiples of 1, 2 or 5 times a power of ten, about `count` of them, from at or below `low` to at or above `high`
/// (up to 1e-9 of a step). Throws std::invalid_argument unless low < high, both finite.
std::vector<double> ticks(double low, double high, int count = 5);

}  // namespace post
