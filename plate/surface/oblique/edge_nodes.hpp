#pragma once
#include <vector>
#include "geometry/shape/outline.hpp"

namespace plate {

/// A node on an edge in any direction, in the middle of its part of the edge. [spacings]
struct EdgeNode {
  geometry::Point at, normal;  // outward
  double length;               // of its part
};

/// About one a spacing along every edge and every round hole, of equal parts, none at corners.
/// @param outline  [spacings]
std::vector<EdgeNode> edge_nodes(const geometry::Outline& outline);

}  // namespace plate
