#pragma once
#include <array>
#include <optional>
#include <vector>

#include "geometry/shape/outline.hpp"

namespace plate {

/// Mesh for drawing a plate: its points and the cells between them.
struct Mesh {
  std::vector<geometry::Point> positions;  // [length]
  std::vector<double> areas;               // [length^2]
  std::vector<double> cut;                 // share of each point's full family cut by cracks and edges
  /// Cells of points, and of corners after them, counter-clockwise; at a crack each face has its own.
  std::vector<std::array<std::uint32_t, 4>> quads;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double spacing = 0, thickness = 0;  // [length]

  /// A corner of cells on an edge or a crack where there is no point, and the points that give its values: linear ones
  /// for displacements, a mean for what is derived from them.
  struct Source {
    std::uint32_t point;
    double linear, mean;
  };
  struct Corner {
    geometry::Point position;  // [length]
    std::vector<Source> sources;
  };
  std::vector<Corner> corners = {};
  std::size_t others = 0;  // points at the end of `positions` that are in no cell: corners take values from them
  std::optional<std::size_t> own = {};  // points at the beginning that no other process has; absent: one has all
  /// Global numbers of the points, where the plate is distributed and these points are in no rows of a lattice.
  std::vector<std::uint32_t> numbers = {};
};

}  // namespace plate
