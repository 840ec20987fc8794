#pragma once
#include <cstddef>
#include <string>

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

}  // namespace post
