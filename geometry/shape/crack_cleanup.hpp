#pragma once
#include "geometry/shape/crack_path.hpp"

namespace geometry {

/// An end of a crack that was put onto the boundary or onto another crack.
struct Snap {
  std::size_t crack = 0;
  bool at_back = false;
  double distance = 0;
  std::string onto;  // name of the edge or hole, or "cracks[1]"
};

struct Snapped {
  std::vector<Polyline> cracks;
  std::vector<Snap> snaps;
};

/// Puts ends no farther than `reach` and a thousandth of their own segment from an edge, a hole or another crack onto
/// it: coordinates that were rounded. Cracks with fewer than two vertices stay as they are.
Snapped snapped(const Outline& outline, std::vector<Polyline> cracks, double reach);

/// Crack `crack` of a list went on from crack `onto` in one line.
struct Continuation {
  std::size_t crack = 0, onto = 0;
};

/// Cracks without the vertices that only say how they were drawn.
struct Merged {
  std::vector<Polyline> cracks;
  std::vector<Continuation> continuations;  // numbers of the list that was given
};

/// Removes vertices on straight lines, and joins cracks that go on from each other in one line, so that one crack has
/// one description. A vertex counts as on the line if it is off by no more than a ten-thousandth of the shorter piece
/// beside it: coordinates that were rounded. Vertices at which another crack ends or crosses stay, and so do two ends
/// on the boundary. A joined crack has the place of its first piece in the list, and its tips keep the order that the
/// pieces gave them. `cracks` without errors.
Merged merged(const Outline& outline, std::vector<Polyline> cracks);

}  // namespace geometry
