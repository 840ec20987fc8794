#include "plate/model/loading/moving_forces.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/cells/tessellation.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/model/loading/spread.hpp"
#include "plate/model/loads.hpp"

namespace plate {
namespace {

using geometry::Point;

constexpr int per_spacing = 4;  // stations

struct Place {
  double time;
  Point x;
};

/// Corners of the path and places between them, at most a quarter of a spacing apart.
std::vector<Place> places_on(const Load& load, double spacing) {
  std::vector<Place> result{{0, load.path.front()}};
  double time = 0;
  for (std::size_t i = 0; i + 1 < load.path.size(); ++i) {
    const Point way = load.path[i + 1] - load.path[i];
    const double duration = way.norm() / load.speed;
    if (duration == 0) continue;
    const int parts = std::max(1, int(std::ceil(per_spacing * way.norm() / spacing - 1e-6)));
    for (int n = 1; n <= parts; ++n) result.push_back({time + duration * n / parts, load.path[i] + way * n / parts});
    time += duration;
  }
  return result;
}

/// A force of the size `value`, spread over a square of a spacing in samples, each at the point next to it with its
/// lever: it keeps its size and its place, and grows smoothly from point to point. `sees`: are the points about a place
/// there?
template <typename Sees>
void add_force(double value, const Point& at, const std::vector<Point>& positions,
               const std::vector<std::uint32_t>& near, double spacing, const Sees& sees, Forces& forces) {
  constexpr int samples = 8;
  for (int i = 0; i < samples; ++i)
    for (int j = 0; j < samples; ++j) {
      const Point x = at + spacing * Point((i + 0.5) / samples - 0.5, (j + 0.5) / samples - 0.5);
      if (near.empty() || !sees(x)) continue;
      const auto k = *std::ranges::min_element(near, {}, [&](auto n) { return (positions[n] - x).squaredNorm(); });
      forces.col(k) += moved_force(value / (samples * samples), at - positions[k]);
    }
}

/// The load with its part of the plate moved from the begin of the path to a place.
Load moved(Load load, const Point& to) {
  const Point by = to - load.path.front();
  load.path.clear();
  if (auto* circle = std::get_if<geometry::Circle>(&*load.patch)) circle->centre += by;
  if (auto* polygon = std::get_if<geometry::Polygon>(&*load.patch))
    for (auto& x : polygon->vertices) x += by;
  return load;
}

/// `press(load, forces)`: adds a pressure that rests.
template <typename Sees, typename Press>
MovingForces stations(const Load& load, const std::vector<Point>& positions, std::size_t count, double spacing,
                      const Sees& sees, const Press& press) {
  MovingForces result;
  std::vector<std::uint32_t> near;
  for (std::uint32_t k = 0; k < count; ++k)
    if (geometry::distance(load.path, positions[k]) < 3 * spacing) near.push_back(k);
  Forces forces = Forces::Zero(3, Eigen::Index(positions.size()));
  for (const auto& [time, x] : places_on(load, spacing)) {
    forces.setZero();
    if (load.kind == Load::Kind::point_force)
      add_force(load.value, x, positions, near, spacing, sees, forces);
    else
      press(moved(load, x), forces);
    auto& station = result.stations.emplace_back(MovingForces::Station{time, {}});
    for (std::uint32_t dof = 0; dof < forces.size(); ++dof)
      if (const double force = at_dof(forces, dof); force != 0) station.forces.emplace_back(dof, force);
  }
  return result;
}

}  // namespace

std::size_t MovingForces::after(double time) const {
  const auto next = std::ranges::upper_bound(stations, time, {}, &Station::time);
  if (next == stations.end() && !stations.empty() && time == stations.back().time) return stations.size() - 1;
  return std::size_t(next - stations.begin());
}

Forces MovingForces::whole(double time, std::size_t points) const {
  Forces result = Forces::Zero(3, Eigen::Index(points));
  at(time, [&](std::uint32_t dof, double force) { at_dof(result, dof) += force; });
  return result;
}

MovingForces moving_forces(const Load& load, const geometry::Cloud& cloud, const std::vector<char>& own) {
  auto result = stations(
      load, cloud.positions, cloud.plate_points, cloud.units.spacing, [&](const Point& x) { return cloud.seeded(x); },
      [&](const Load& now, Forces& forces) { add_pressure(now, cloud, own, forces); });
  result.own = own;
  return result;
}

MovingForces moving_forces(const Load& load, const geometry::Tessellation& cells, std::size_t points,
                           const std::vector<char>& own) {
  return stations(
      load, cells.positions, points, cells.units.spacing, [&](const Point& x) { return cells.sees(x); },
      [&](const Load& now, Forces& forces) { add_pressure(now, cells, own, forces); });
}

}  // namespace plate
