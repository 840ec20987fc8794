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

}  // namespace geometry
