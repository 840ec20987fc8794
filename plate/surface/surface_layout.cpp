#include "plate/surface/surface_layout.hpp"

#include <fmt/format.h>
#include <algorithm>
#include "geometry/lattice/seeding.hpp"
#include "plate/model/refused.hpp"

namespace plate {

namespace {

using geometry::Point;

[[noreturn]] void refuse(Subject subject, std::string what, std::size_t number = 0) {
  throw Refused({{subject, number, std::move(what)}});
}

/// Lower left and upper right corner.
std::pair<Point, Point> rectangle_of(const Problem& problem) {
  const auto edges = geometry::straight_edges(problem.outline);
  const auto along_axes = [](const geometry::Edge& e) { return e.from.x() == e.to.x() || e.from.y() == e.to.y(); };
  if (!problem.outline.holes.empty() || edges.size() != 4 || !std::ranges::all_of(edges, along_axes))
    refuse(Subject::geometry,
           "surface nodes are of rectangles along the axes without holes: choose boundary = \"images\"");
  if (!problem.cracks.empty())
    refuse(Subject::cracks, "surface nodes are of plates without cracks: choose boundary = \"images\"");
  return geometry::bounding_box(problem.outline);
}

SurfacePlate plate_of(const Problem& problem, const Point& low, const Point& high) {
  constexpr double least = 0.05;  // spacings: expansions through an edge and a point so near enlarge what they see
  auto plate = surface_plate(problem.section, problem.discretization, low, high);
  for (const auto& face : plate.body.surface)
    if (face.distance < least) {
      const double side = (high - low)[face.axis];
      const double cells = std::round(side / plate.bonds.spacing);
      refuse(Subject::spacing,
             fmt::format("an edge lies {:.2g} spacings beyond a row of points; spacing {:.6g} would put "
                         "it half a spacing beyond",
                         face.distance, side / cells));
    }
  return plate;
}

/// Of the surface nodes, in their order: the side on which each lies.
std::vector<std::size_t> sides_of_nodes(const SurfacePlate& plate, const Boundary& boundary) {
  std::vector<std::size_t> result;
  for (int s = 0; s < int(plate.body.surface.size()); ++s) {
    const Point u = boundary.cloud.units.to_units(plate.at_surface(s)), n = plate.normal(s);
    const auto found = std::ranges::find_if(boundary.sides, [&](const Side& side) {
      return side.outward(u).dot(n) > 0.5;  // each side of a rectangle has a normal of its own
    });
    result.push_back(std::size_t(found - boundary.sides.begin()));
  }
  return result;
}

Boundary boundary_of(const Problem& problem, const SurfacePlate& plate) {
  Boundary b;
  b.cloud = geometry::lattice(problem.outline, problem.discretization.spacing);
  if (int(b.cloud.plate_points) != plate.body.real)
    refuse(Subject::spacing, "an edge passes through a row of points: change the spacing");
  for (int s = 0; s < int(plate.body.surface.size()); ++s) {
    b.cloud.positions.push_back(plate.at_surface(s));
    b.cloud.areas.push_back(0);
  }
  for (const auto& x : b.cloud.positions) b.lattice.push_back(b.cloud.units.to_units(x));
  b.sides = sides_of(geometry::to_lattice(problem.outline, b.cloud.units), problem.supports);
  b.holders = holders_of(problem.supports);
  b.active.assign(b.cloud.size(), 1);
  std::fill(b.active.begin() + plate.body.real, b.active.end(), 0);
  return b;
}

void hold(const SurfacePlate& plate, const std::vector<std::size_t>& side_of, Boundary& b) {
  for (std::uint32_t s = 0; s < side_of.size(); ++s) {
    b.fictitious.push_back({{int(side_of[s]), -1}, false, false});
    const auto condition = edge_condition(b.sides[side_of[s]].kind);
    const int axis = plate.body.surface[s].axis;
    const int components[] = {0, normal_rotation(axis), tangential_rotation(axis)};
    for (std::size_t i = 0; i < 3; ++i)
      if (condition.held[i]) b.constraints.fix(std::uint32_t(3 * (plate.body.real + int(s)) + components[i]));
  }
  for (std::uint32_t pin = 0; pin < b.holders.size(); ++pin)
    if (const auto& at = b.holders[pin].position) {
      const auto k = std::uint32_t(geometry::nearest_plate_point(b.cloud, *at));
      b.constraints.fix(3 * k);
      b.holds.push_back({k, pin, false});
    }
  b.constraints.resolve();
}

/// What a load does to an edge with this normal.
EdgeAction action_of(const Load& load, const Point& n) {
  EdgeAction action;
  const auto given = [](double value) { return value == 0 ? std::nullopt : std::optional(value); };
  if (load.kind == Load::Kind::edge_shear) action.shear = given(load.value);
  if (load.kind != Load::Kind::edge_moment) return action;
  action.moment = given(load.value), action.twisting_moment = given(load.twist);
  if (!load.has_tensor) return action;
  const auto [xx, yy, xy] = load.tensor;
  const Point moment(xx * n.x() + xy * n.y(), xy * n.x() + yy * n.y());
  action.moment = given(moment.dot(n)), action.twisting_moment = given(moment.dot(Point(-n.y(), n.x())));
  return action;
}

Forces forces_of(const Load& load, std::size_t number, const SurfacePlate& plate, const Boundary& b,
                 const geometry::Outline& outline) {
  if (load.kind == Load::Kind::point_force) return nodal_forces(load, b.cloud, outline);
  const double pressure = load.kind == Load::Kind::pressure ? load.value : 0;
  const auto on_edges = [&](const Point& at, const Point& n) {
    const auto& side = *std::ranges::find_if(b.sides, [&](const Side& one) { return one.outward(at).dot(n) > 0.5; });
    const bool loaded = std::ranges::find(load.edges, side.name) != load.edges.end();
    auto condition = edge_condition(side.kind, loaded ? action_of(load, n) : EdgeAction{}, number);
    condition.held = {false, false, false};  // forces on what is held are booked to the supports
    return condition;
  };
  const auto right = edge_problem(plate, on_edges, [&](const Point&) { return Eigen::Vector3d(pressure, 0, 0); }).right;
  return Eigen::Map<const Eigen::Matrix3Xd>(right.data(), 3, Eigen::Index(b.cloud.size()));
}

}  // namespace

SurfaceLayout surface_layout(const Problem& problem) {
  const auto [low, high] = rectangle_of(problem);
  SurfacePlate plate = plate_of(problem, low, high);
  Layout layout{problem, {}, {}, boundary_of(problem, plate), {}, {}};
  auto& b = layout.boundary;
  const auto side_of = sides_of_nodes(plate, b);
  hold(plate, side_of, b);
  layout.cut.assign(b.cloud.plate_points, 0);
  for (std::size_t i = 0; i < problem.loads.size(); ++i)
    layout.loads.push_back({forces_of(problem.loads[i], i, plate, b, problem.outline), problem.loads[i].history});
  std::vector<HeldUnknown> held;
  for (const auto dof : b.constraints.held()) held.push_back({Eigen::Index(dof), 0});
  layout.pieces = {{b.cloud.plate_points, b.cloud.positions.front(), 0, rigid_motions(plate, held)}};
  return {std::move(layout), std::move(plate)};
}

}  // namespace plate
