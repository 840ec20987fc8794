#pragma once
#include <string>
#include <vector>

#include "geometry/lattice/cloud.hpp"
#include "geometry/shape/outline.hpp"

namespace plate {

/// A short piece of an edge: its middle, its outward normal times its length.
struct EdgePiece {
  geometry::Point middle;
  geometry::Point normal;
};

/// All pieces of one straight edge or circle, with the points of the plate near it.
struct EdgeBorder {
  std::vector<EdgePiece> pieces;
  std::vector<std::uint32_t> near;
};

/// Of all edges of a name; eight pieces per spacing, so that each lies in one cell where the edge follows the lattice.
/// `outline` in the cloud's own units. Throws std::invalid_argument for an edge without points beside it.
std::vector<EdgeBorder> edge_borders(const std::string& name, const geometry::Cloud& cloud,
                                     const geometry::Outline& outline);

/// Of these points, the one next to x.
std::uint32_t nearest(const std::vector<std::uint32_t>& points, const geometry::Cloud& cloud, const geometry::Point& x);

}  // namespace plate
