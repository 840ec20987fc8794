#pragma once
#include <array>
#include <vector>

#include "geometry/shape/outline.hpp"

namespace plate {

/// What is drawn of a plate: its points and the cells between them.
struct Mesh {
  std::vector<geometry::Point> positions;           // [length]
  std::vector<double> areas;                        // [length^2]
  std::vector<double> cut;                          // share of each point's full family severed by cracks and edges
  std::vector<std::array<std::uint32_t, 4>> quads;  // of neighbouring points that see each other
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double spacing = 0, thickness = 0;  // [length]
};

}  // namespace plate
