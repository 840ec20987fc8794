#pragma once
#include <string>
#include <vector>

namespace post {

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

  /// Where a value lies: 0 at the low end, 1 at the high end.
  double share(double value) const;
};

/// The axis of a range, low < high, both finite, and positive on a logarithmic scale; about `count` labels on a linear
/// one. `covers`: a linear axis begins and ends with a tick, otherwise with the range.
PlotAxis plot_axis(const Range& range, Scale scale, int count, bool covers);

/// What an axis says, as SVG text: its name, and the power of ten that its labels leave out.
std::string axis_title(const std::string& name, const PlotAxis& axis);

/// Multiples of 1, 2 or 5 times a power of ten, about `count` of them, from at or below `low` to at or above `high`
/// (up to 1e-9 of a step). Throws std::invalid_argument unless low < high, both finite.
std::vector<double> ticks(double low, double high, int count = 5);

}  // namespace post
