#pragma once
#include <cstdint>
#include <functional>

#include "geometry/lattice/cloud.hpp"

namespace geometry {

/// Wanted distance between neighbouring points about a place.
using Sizing = std::function<double(const Point&)>;

/// Next to a line of lattice points: the noise of decimals, in a plate far from the origin too [spacings].
Point onto_lattice(const Point& u, double noise = 1e-9);

/// Outline, holes and cracks as nodes and the straight pieces between neighbouring nodes; all in lattice units. Nodes
/// are not rounded: those of a straight line lie on it as far as numbers allow.
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
/// Where `on_lattice`, pieces that lie along the lattice take its points, and nodes next to it are put onto it. What is
/// closer together than 1e-5 of the distance of points there is one place: so the end of a crack next to an edge or to
/// another crack is put onto it.
Curves curves(const Outline& outline, std::vector<CrackPath> cracks, const std::vector<Point>& singles,
              const Sizing& sizing, bool on_lattice);

}  // namespace geometry
