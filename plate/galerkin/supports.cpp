#include "plate/galerkin/supports.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace plate {
namespace {

using geometry::Point;

/// What supports ask of one point: w = 0, and d . psi = 0 for every direction d.
struct Held {
  bool w = false;
  std::vector<Point> directions;
  std::set<std::uint32_t> holders_of_w, holders_of_psi;
};

/// Adds a direction; one within 30 degrees of another is merged with it, on a circle, of which there are eight pieces
/// at least, within 60.
void add_direction(std::vector<Point>& directions, const Point& d, bool round) {
  for (auto& known : directions)
    if (std::abs(known.normalized().dot(d)) > (round ? 0.5 : std::sqrt(0.75))) {
      known += known.dot(d) > 0 ? d : Point(-d);
      return;
    }
  directions.push_back(d);
}

void hold(Held& held, SupportKind kind, std::uint32_t holder, const Point& normal, bool round) {
  const Point along(-normal.y(), normal.x());
  held.w = held.w || kind != SupportKind::symmetry;
  if (kind != SupportKind::symmetry) held.holders_of_w.insert(holder);
  if (kind != SupportKind::simply_supported) held.holders_of_psi.insert(holder);
  if (kind == SupportKind::clamped || kind == SupportKind::symmetry) add_direction(held.directions, normal, round);
  if (kind == SupportKind::clamped || kind == SupportKind::simply_supported_hard)
    add_direction(held.directions, along, round);
}

/// psi = (-theta_y, theta_x)
void impose(Constraints& constraints, std::uint32_t k, const Held& held) {
  if (held.w) constraints.fix(3 * k);
  if (held.directions.size() > 1) {
    constraints.fix(3 * k + 1), constraints.fix(3 * k + 2);
  } else if (held.directions.size() == 1) {
    const Point d = held.directions.front().normalized();
    const auto larger = std::abs(d.y()) >= std::abs(d.x()) ? 3 * k + 1 : 3 * k + 2, other = 6 * k + 3 - larger;
    const double ratio = larger % 3 == 1 ? d.x() / d.y() : d.y() / d.x();
    if (std::abs(ratio) < 1e-9)
      constraints.fix(larger);
    else
      constraints.tie(larger, {{other, ratio}});
  }
}

}  // namespace

Boundary galerkin_boundary(const geometry::Tessellation& cells, const std::vector<double>& areas,
                           const geometry::Outline& outline, const std::vector<Support>& supports) {
  Boundary result;
  result.cloud = {cells.units, cells.positions, areas, cells.positions.size()};
  for (const auto& x : cells.positions) result.lattice.push_back(cells.units.to_lattice(x));
  result.sides = sides_of(outline, supports);
  result.active.assign(cells.positions.size(), 1);

  result.holders = holders_of(supports);
  std::set<std::string> round;
  for (const auto& side : result.sides)
    if (side.circle) round.insert(side.name);
  std::map<std::uint32_t, Held> held;
  for (const auto& border : cells.borders) {
    if (border.edge == geometry::Curves::crack) continue;
    const auto by = holder(result.holders, cells.names[std::size_t(border.edge)]);
    if (by == result.holders.size()) continue;
    const Point along = (cells.positions[border.to] - cells.positions[border.from]).normalized();
    const auto& [name, kind, position] = result.holders[by];
    for (const auto k : {border.from, border.to})
      hold(held[k], kind, by, {along.y(), -along.x()}, round.contains(name));
  }
  for (const auto& [k, what] : held) {
    impose(result.constraints, k, what);
    for (const auto by : what.holders_of_w) result.holds.push_back({k, by, false});
    for (const auto by : what.holders_of_psi) result.holds.push_back({k, by, true});
  }
  for (std::uint32_t pin = 0; pin < result.holders.size(); ++pin) {
    if (!result.holders[pin].position) continue;
    const auto nearest = geometry::nearest_plate_point(result.cloud, *result.holders[pin].position);
    for (std::uint32_t k = 0; k < cells.positions.size(); ++k)
      if (cells.positions[k] == cells.positions[nearest])
        result.constraints.fix(3 * k), result.holds.push_back({k, pin, false});
  }
  result.constraints.resolve();
  return result;
}

}  // namespace plate
