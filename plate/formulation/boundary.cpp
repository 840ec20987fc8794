#include "plate/formulation/boundary.hpp"

#include <algorithm>
#include <cmath>

namespace plate {

using geometry::Point;

double Side::inside(const Point& u) const {
  if (circle) return (u - centre).norm() - radius;
  return -outward(u).dot(u - edge.from);
}

Point Side::outward(const Point& u) const {
  if (circle) return (centre - u).normalized();
  const Point along = (edge.to - edge.from).normalized();
  return {along.y(), -along.x()};
}

int Side::normal_axis() const {
  if (circle) return -1;
  if (edge.from.x() == edge.to.x()) return 0;
  return edge.from.y() == edge.to.y() ? 1 : -1;
}

bool Side::along_lattice() const {
  const int axis = normal_axis();
  return axis >= 0 && edge.from[axis] == std::round(edge.from[axis]);
}

Point Side::mirrored(const Point& u) const {
  Point image = u;
  image[normal_axis()] = 2 * edge.from[normal_axis()] - u[normal_axis()];
  return image;
}

bool Side::meets(const Point& p, const Point& q) const {
  if (circle) return geometry::distance({p, q}, centre) < radius;
  return geometry::meet(p, q, edge.from, edge.to);
}

std::vector<Side> sides_of(const geometry::Outline& outline, const std::vector<Support>& supports) {
  std::vector<Side> sides;
  for (const auto& edge : geometry::straight_edges(outline)) sides.push_back({edge.name, false, edge, {0, 0}, 0, {}});
  for (const auto& hole : outline.holes)
    if (const auto* circle = std::get_if<geometry::Circle>(&hole))
      sides.push_back({circle->name, true, {}, circle->centre, circle->radius, {}});
  for (auto& side : sides)
    for (const auto& support : supports)
      if (std::find(support.edges.begin(), support.edges.end(), side.name) != support.edges.end())
        if (!support.holds_nothing()) side.kind = support.kind;
  return sides;
}

std::vector<Holder> holders_of(const std::vector<Support>& supports) {
  using enum Holder::Place;
  std::vector<Holder> holders;
  std::size_t pins = 0, lines = 0, parts = 0, hubs = 0;
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const auto& support = supports[i];
    const auto add = [&](const std::string& name, const std::optional<Point>& position, Holder::Place place) {
      if (!support.holds_nothing())
        holders.push_back({.name = name,
                           .kind = support.kind,
                           .position = position,
                           .place = place,
                           .push = support.push,
                           .support = i});
    };
    for (const auto& name : support.edges)
      if (holder(holders, name) == holders.size()) add(name, std::nullopt, edge);
    for (const auto& x : support.points) add("pin" + std::to_string(pins++), x, point);
    if (!support.along.empty()) add("line" + std::to_string(lines++), std::nullopt, inside);
    if (!support.patch) continue;
    const bool hub = support.kind == SupportKind::hub;
    add(hub ? "hub" + std::to_string(hubs++) : "part" + std::to_string(parts++), std::nullopt, inside);
  }
  return holders;
}

std::uint32_t holder(const std::vector<Holder>& holders, const std::string& name) {
  const auto found =
      std::ranges::find_if(holders, [&](const Holder& h) { return h.place == Holder::Place::edge && h.name == name; });
  return std::uint32_t(found - holders.begin());
}

std::uint32_t holder(const std::vector<Holder>& holders, const Side& side) {
  if (!side.support) return holder(holders, side.name);
  const auto found = std::ranges::find_if(
      holders, [&](const Holder& h) { return h.place == Holder::Place::inside && h.support == *side.support; });
  return std::uint32_t(found - holders.begin());
}

}  // namespace plate
