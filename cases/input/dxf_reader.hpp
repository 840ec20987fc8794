#pragma once
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "geometry/shape/crack_path.hpp"

namespace cases {

/// A piece of a curve of a drawing: straight, or smooth as a fine polyline [units of the drawing].
struct DrawnPiece {
  geometry::Polyline points;
  std::optional<geometry::Circle> circle = {};  // that an arc is of
  std::string layer = {};                       // in small letters
  std::size_t line = 0;                         // of the file, where its entity begins

  bool straight() const { return points.size() == 2; }
};

/// Content of a DXF drawing on some of its layers.
struct DxfDrawing {
  std::vector<DrawnPiece> pieces;     // LINE, LWPOLYLINE, POLYLINE, ARC, CIRCLE, SPLINE
  std::set<std::string> layers;       // all that have entities, as they are spelled
  int unit = 0;                       // $INSUNITS
  std::vector<std::string> problems;  // "line 12: ELLIPSE on layer outline ..."
};

/// Name of a layer in small letters: DXF does not tell them apart.
std::string layer_key(std::string name);

/// Reads an ASCII DXF file by dxflib. Paper space is not read. `layers`: those that are wanted, by layer_key(). Text,
/// dimensions and points on them are passed over; any other entity that is no curve is a problem.
DxfDrawing read_dxf(const std::filesystem::path& path, const std::set<std::string>& layers);

}  // namespace cases
