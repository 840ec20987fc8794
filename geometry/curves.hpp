#pragma once
#include <cstdint>
#include <functional>
#include "geometry/cloud.hpp"

namespace geometry {

/// Wanted distance between neighbouring points about a place.
using Sizing = std::function<double(const Point&)>;

/// Outline, holes and cracks as nodes and the straight pieces between neighbouring nodes; all in lattice units.
struct Curves {
  struct Piece {
    std::uint32_t from, to;  // an edge has the plate on its left
    std::int32_t edge;       // which of the names; -1: of a crack
  };
  static constexpr std::int32_t crack = -1;

  std::vector<Point> nodes;
  std::vector<Piece> pieces;
  std::vector<std::string> names;  // of the edges
  Outline outline;                 // circles as the polygons of their nodes
};

/// Nodes at corners, ends, crossings and the single points given, and between them as far apart as `sizing` wants.
/// Pieces that lie along the lattice take its points where `on_lattice`. An end of a crack within 1e-5 of an edge or of
/// another crack is put onto it.
Curves curves(const Outline& outline, std::vector<CrackPath> cracks, const std::vector<Point>& singles,
              const Sizing& sizing, bool on_lattice);

}  // namespace geometry
