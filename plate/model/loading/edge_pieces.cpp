#include "plate/model/loading/edge_pieces.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace plate {
namespace {

using geometry::Point;

std::vector<EdgePiece> pieces_of(const geometry::Edge& edge, double spacing) {
  const Point along = edge.to - edge.from;
  const auto count = static_cast<int>(std::ceil(8 * along.norm() / spacing - 1e-6));
  const Point step = along / count;
  std::vector<EdgePiece> pieces;
  for (int i = 0; i < count; ++i) pieces.push_back({edge.from + (i + 0.5) * step, {step.y(), -step.x()}});
  return pieces;
}

std::vector<EdgePiece> pieces_of(const geometry::Circle& hole, double spacing) {
  const auto count = static_cast<int>(std::ceil(16 * std::numbers::pi * hole.radius / spacing));
  const double angle = 2 * std::numbers::pi / count;
  std::vector<EdgePiece> pieces;
  for (int i = 0; i < count; ++i) {
    const Point radial(std::cos((i + 0.5) * angle), std::sin((i + 0.5) * angle));
    pieces.push_back({hole.centre + hole.radius * radial, -hole.radius * angle * radial});
  }
  return pieces;
}

}  // namespace

std::vector<EdgeBorder> edge_borders(const std::string& name, const geometry::Cloud& cloud,
                                     const geometry::Outline& outline) {
  const double spacing = cloud.units.spacing, reach = 2 * spacing;
  std::vector<EdgeBorder> result;
  const auto near = [&](const auto& away) {
    std::vector<std::uint32_t> points;
    for (std::uint32_t k = 0; k < cloud.plate_points; ++k)
      if (away(cloud.positions[k]) < reach) points.push_back(k);
    return points;
  };
  for (const auto& edge : geometry::straight_edges(outline))
    if (edge.name == name)
      result.push_back({pieces_of(edge, spacing), near([&](const Point& x) {
                          return geometry::distance(geometry::Polyline{edge.from, edge.to}, x);
                        })});
  for (const auto& hole : outline.holes)
    if (const auto* circle = std::get_if<geometry::Circle>(&hole); circle && circle->name == name)
      result.push_back({pieces_of(*circle, spacing),
                        near([&](const Point& x) { return std::abs((x - circle->centre).norm() - circle->radius); })});
  if (cloud.part) std::erase_if(result, [](const EdgeBorder& border) { return border.near.empty(); });  // elsewhere
  for (const auto& border : result)
    if (border.near.empty())
      throw std::invalid_argument("edge '" + name + "' has no point of the plate within two spacings");
  return result;
}

std::uint32_t nearest(const std::vector<std::uint32_t>& points, const geometry::Cloud& cloud, const Point& x) {
  std::uint32_t best = points.front();
  for (const auto k : points)
    if ((cloud.positions[k] - x).squaredNorm() < (cloud.positions[best] - x).squaredNorm()) best = k;
  return best;
}

}  // namespace plate
