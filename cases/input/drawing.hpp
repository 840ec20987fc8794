#pragma once
#include "cases/input/dxf_reader.hpp"

namespace cases {

/// Names of the layers of a drawing that are read.
struct DrawingLayers {
  std::string outline = "outline", holes = "holes", cracks = "cracks";
  std::vector<std::string> edges = {};  // further layers of the outline: each is an edge of its name

  /// All of them, by layer_key().
  std::set<std::string> all() const;
};

/// Outline, holes and cracks that were joined from the pieces of a drawing, in its units.
struct JoinedDrawing {
  geometry::Outline outline;  // no vertices where the drawing has none
  std::vector<geometry::Polyline> cracks;
  double off = 0;                     // the largest distance of a chord of the outline or a hole from its curve
  std::vector<std::string> problems;  // with layer and place
};

/// Joins pieces whose ends are no more than `join` apart: loops of the outline and holes, counter-clockwise, and
/// cracks. The outline begins at its lowest corner, of two the left one; the edges on its layer are called edge0, edge1
/// and so on, those of a rectangle along the axes left, right, bottom, top. A hole of arcs of one circle is this
/// circle. Other curves of outline and holes become chords that turn by 15 degrees at most and are about as long as
/// `chord`, where this is greater than zero. [all lengths in units of the drawing]
JoinedDrawing joined(std::vector<DrawnPiece> pieces, const DrawingLayers& layers, double join, double chord);

/// Length of a unit of $INSUNITS [m], with its name; nothing of a drawing without units.
std::optional<std::pair<double, std::string>> metres_of(int unit);

}  // namespace cases
