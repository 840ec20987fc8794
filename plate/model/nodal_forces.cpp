#include "plate/model/nodal_forces.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/cells/tessellation.hpp"
#include "geometry/lattice/cloud.hpp"
#include "geometry/shape/patch.hpp"
#include "plate/model/load_integration.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/problem_validation.hpp"
#include "plate/model/state.hpp"

namespace plate {
namespace {

using geometry::Point;

constexpr int per_spacing = 4;  // stations

struct PathPlace {
  double time;
  Point x;
};

/// Corners of the path and places between them, at most a quarter of a spacing apart.
std::vector<PathPlace> places_on(const geometry::Polyline& path, double speed, double spacing) {
  std::vector<PathPlace> result{{0, path.front()}};
  double time = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Point way = path[i + 1] - path[i];
    const double duration = way.norm() / speed;
    if (duration == 0) continue;
    const int parts = std::max(1, int(std::ceil(per_spacing * way.norm() / spacing - 1e-6)));
    for (int n = 1; n <= parts; ++n) result.push_back({time + duration * n / parts, path[i] + way * n / parts});
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

/// The pressure with its part of the plate moved from the begin of the path to a place.
Pressure moved(Pressure pressure, const Point& to) {
  pressure.patch = geometry::moved(*pressure.patch, to - pressure.path.front());
  pressure.path.clear();
  return pressure;
}

/// `press(pressure, forces)`: adds a pressure that rests.
template <typename Sees, typename Press>
MovingForces stations(const Load& load, const std::vector<Point>& positions, std::size_t count, double spacing,
                      const geometry::Outline* outline, const Sees& sees, const Press& press) {
  MovingForces result;
  std::vector<std::uint32_t> near;
  for (std::uint32_t k = 0; k < count; ++k)
    if (geometry::distance(load.path(), positions[k]) < 3 * spacing) near.push_back(k);
  Forces forces = zero_forces(positions.size());
  for (const auto& [time, x] : places_on(load.path(), load.speed(), spacing)) {
    forces.setZero();
    if (const auto* force = load.as<PointForce>(); force && (!outline || on_plate(*outline, x)))
      add_force(force->value, x, positions, near, spacing, sees, forces);
    else if (!force)
      press(moved(*load.as<Pressure>(), x), forces);
    auto& station = result.stations.emplace_back(MovingForces::Station{time, {}});
    for (Eigen::Index k = 0; k < forces.cols(); ++k)
      for (const auto dof : dofs_of(k))
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
  Forces result = zero_forces(points);
  at(time, [&](const Dof& dof, double force) { at_dof(result, dof) += force; });
  return result;
}

MovingForces moving_forces(const Load& load, const geometry::Cloud& cloud, const PointMap& map,
                           const geometry::Outline* outline) {
  auto result = stations(
      load, cloud.positions, cloud.plate_points, cloud.units.spacing, outline,
      [&](const Point& x) { return cloud.seeded(x); },
      [&](const Pressure& now, Forces& forces) { add_pressure(now, cloud, map, forces); });
  result.own = map.owned;
  return result;
}

MovingForces moving_forces(const Load& load, const geometry::Tessellation& cells, std::size_t points,
                           const PointMap& map, const geometry::Outline* outline) {
  return stations(
      load, cells.positions, points, cells.units.spacing, outline, [&](const Point& x) { return cells.sees(x); },
      [&](const Pressure& now, Forces& forces) { add_pressure(now, cells, map, forces); });
}

namespace {

/// Couple of a moment, or of a force in the plane, that does the work M . (u, v)/z.
PointValues couple_of(const Point& moment) {
  return {0, -moment.y(), moment.x()};
}

/// Nodal forces of each kind of load on the points of a lattice.
struct OnLattice {
  const geometry::Cloud& cloud;
  const geometry::Outline& outline;
  const PointMap& map;
  const std::vector<geometry::CrackPath>& cracks;
  Forces& forces;

  void operator()(const Pressure& load) const {
    if (!load.uniform()) return add_pressure(load, cloud, map, forces);
    for (std::uint32_t k = 0; k < cloud.plate_points; ++k) forces(0, k) = load.value * cloud.areas[k];
  }
  void operator()(const LineLoad& load) const { add_line_load(load, cloud, cracks, forces); }
  void operator()(const PointForce& load) const {
    if (!cloud.seeded(load.position)) return;
    const auto k = geometry::nearest_plate_point(cloud, load.position);
    forces.col(static_cast<Eigen::Index>(k)) = moved_force(load.value, load.position - cloud.positions[k]);
  }
  void operator()(const EdgeMoment& load) const {
    on_pieces(load.edges, [&](const EdgePiece& piece, const Point&) { return couple_of(load.on(piece.normal)); });
  }
  void operator()(const EdgeShear& load) const {
    on_pieces(load.edges, [&](const EdgePiece& piece, const Point& lever) {
      return moved_force(load.value * piece.normal.norm(), lever);
    });
  }
  template <class Other>
  void operator()(const Other&) const {}

private:
  /// `force(piece, lever)`: of a piece of an edge, at the point next to it.
  template <typename Force>
  void on_pieces(const std::vector<std::string>& edges, const Force& force) const {
    for (const auto& name : edges)
      for (const EdgeBorder& border : edge_borders(name, cloud, outline))
        for (const EdgePiece& piece : border.pieces) {
          const auto k = nearest(border.near, cloud, piece.middle);
          forces.col(k) += force(piece, piece.middle - cloud.positions[k]);
        }
  }
};

/// Nodal forces of each kind of load on points that lie on the edges.
struct OnCells {
  const geometry::Tessellation& cells;
  const std::vector<double>& areas;
  const PointMap& map;
  Forces& forces;

  void operator()(const Pressure& load) const {
    if (!load.uniform()) return add_pressure(load, cells, map, forces);
    for (std::size_t k = 0; k < areas.size(); ++k) forces(0, Eigen::Index(k)) = load.value * areas[k];
  }
  void operator()(const LineLoad& load) const { add_line_load(load, cells, forces); }
  void operator()(const PointForce& load) const {
    if (!cells.sees(load.position)) return;
    const auto k = nearest_point(load.position);
    forces.col(Eigen::Index(k)) = moved_force(load.value, load.position - cells.positions[k]);
  }
  void operator()(const EdgeMoment& load) const {
    on_ends(load.edges, [&](const Point& along, int) { return half_couple(load, along); });
  }
  void operator()(const EdgeShear& load) const {
    // a force q on a piece from 0 to l, deflections by the third-order line through both ends: q l^2 / 12 on the slopes
    on_ends(load.edges, [&](const Point& along, int end) {
      return moved_force(load.value * along.norm() / 2, Point(along * (end / 6.0)));
    });
  }
  template <class Other>
  void operator()(const Other&) const {}

protected:
  std::size_t nearest_point(const Point& x) const {
    std::size_t nearest = 0;
    for (std::size_t k = 0; k < areas.size(); ++k)
      if ((cells.positions[k] - x).squaredNorm() < (cells.positions[nearest] - x).squaredNorm()) nearest = k;
    return nearest;
  }
  /// Couple at either end of a piece of an edge.
  static PointValues half_couple(const auto& load, const Point& along) {
    return couple_of(load.on(Point(along.y(), -along.x()) / 2));
  }
  /// `force(along, end)`: of a piece of an edge, at its begin (1) and at its end (-1).
  template <typename Force>
  void on_ends(const std::vector<std::string>& edges, const Force& force) const {
    for (const auto& border : cells.borders) {
      if (border.edge == geometry::Curves::crack) continue;
      const auto& name = cells.names[std::size_t(border.edge)];
      if (std::ranges::find(edges, name) == edges.end()) continue;
      const Point along = cells.positions[border.to] - cells.positions[border.from];
      for (const int end : {1, -1}) forces.col(end > 0 ? border.from : border.to) += force(along, end);
    }
  }
};

/// Nodal forces in the plane, of the loads that act there: conjugate to theta_x = -v and theta_y = u.
struct InPlaneOnCells : OnCells {
  void operator()(const EdgeTraction& load) const {
    on_ends(load.edges, [&](const Point& along, int) { return half_couple(load, along); });
  }
  void operator()(const BodyForce& load) const {
    for (std::size_t k = 0; k < areas.size(); ++k) forces.col(Eigen::Index(k)) = couple_of(areas[k] * load.vector);
  }
  void operator()(const PointForce& load) const {
    if (cells.sees(load.position)) forces.col(Eigen::Index(nearest_point(load.position))) = couple_of(load.vector);
  }
  template <class Other>
  void operator()(const Other&) const {}
};

}  // namespace

Forces nodal_forces(const Load& load, const geometry::Tessellation& cells, const std::vector<double>& areas,
                    const PointMap& map) {
  Forces forces = zero_forces(areas.size());
  if (!load.moves()) std::visit(OnCells{cells, areas, map, forces}, load.action);
  return forces;
}

Forces nodal_forces_in_plane(const Load& load, const geometry::Tessellation& cells, const std::vector<double>& areas) {
  Forces forces = zero_forces(areas.size());
  const PointMap everywhere;
  std::visit(InPlaneOnCells{{cells, areas, everywhere, forces}}, load.action);
  return forces;
}

Forces nodal_forces(const Load& load, const geometry::Cloud& cloud, const geometry::Outline& outline,
                    const PointMap& map, const std::vector<geometry::CrackPath>& cracks) {
  Forces forces = zero_forces(cloud.size());
  if (!load.moves()) std::visit(OnLattice{cloud, outline, map, cracks, forces}, load.action);
  return forces;
}

/// theta_x = psi_y, theta_y = -psi_x
PointValues SupportMotion::at(const Point& x) const {
  const auto& [support, value, slope, from, rotation] = settlement;
  return {value + slope.dot(x - from), slope.y(), -slope.x()};
}

PointValues SupportMotion::at(const Point& x, const Point& outward, double beyond) const {
  return at(x) + settlement.rotation * PointValues(beyond, outward.y(), -outward.x());
}

std::vector<SupportMotion> support_motions(const Problem& problem) {
  std::vector<SupportMotion> result;
  for (std::size_t i = 0; i < problem.loads.size(); ++i)
    if (const auto* settlement = problem.loads[i].as<Settlement>()) result.push_back({i, *settlement});
  return result;
}

Eigen::VectorXd free_curvature(const Load& load, const Section& section, const std::vector<geometry::Point>& positions,
                               std::size_t count) {
  const auto* heat = load.as<Temperature>();
  if (!heat || (heat->value == 0 && !heat->formula.given() && load.in_plane() && !section.couples())) return {};
  const double alpha = section.expands_by_plies() ? 1 : section.thermal_expansion,
               each = section.law == PlateLaw::membrane ? alpha : alpha / section.thickness;
  if (!heat->formula.given()) return Eigen::VectorXd::Constant(Eigen::Index(count), each * heat->value);
  Eigen::VectorXd result(static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k) {
    const double difference = heat->formula(positions[k]);
    if (!std::isfinite(difference)) throw FormulaError(heat->formula, positions[k]);
    result[Eigen::Index(k)] = each * difference;
  }
  return result;
}

Eigen::VectorXd free_curvature_beside(Load load, Section section, const std::vector<geometry::Point>& positions,
                                      std::size_t count) {
  auto* heat = load.as<Temperature>();
  if (!heat || !section.couples()) return {};
  std::swap(heat->value, heat->mean), std::swap(heat->formula, heat->mean_formula);
  section.law = section.law == PlateLaw::membrane ? PlateLaw::bending : PlateLaw::membrane;
  return free_curvature(load, section, positions, count);
}

bool heated(const Problem& problem) {
  return std::ranges::any_of(problem.loads, [](const Load& load) { return load.as<Temperature>() != nullptr; });
}

}  // namespace plate
