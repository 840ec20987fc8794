#include "plate/surface/oblique/edge_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plate {

namespace {

using geometry::Point;

int parts(double length) {
  return std::max(1, int(std::lround(length)));
}

void add(const geometry::Circle& hole, std::vector<EdgeNode>& to) {
  const double around = 2 * std::numbers::pi * hole.radius;
  const int count = std::max(3, parts(around));
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / count;
    const Point out(std::cos(angle), std::sin(angle));
    to.push_back({hole.centre + hole.radius * out, -out, around / count});
  }
}

}  // namespace

std::vector<EdgeNode> edge_nodes(const geometry::Outline& outline) {
  std::vector<EdgeNode> result;
  for (const auto& edge : geometry::straight_edges(outline)) {
    const Point along = edge.to - edge.from, unit = along.normalized();
    const int count = parts(along.norm());
    for (int i = 0; i < count; ++i)
      result.push_back({edge.from + (i + 0.5) / count * along, Point(unit.y(), -unit.x()), along.norm() / count});
  }
  for (const auto& hole : outline.holes)
    if (const auto* circle = std::get_if<geometry::Circle>(&hole)) add(*circle, result);
  return result;
}

}  // namespace plate
