#include "plate/surface/surface_layout.hpp"

#include <fmt/format.h>
#include <algorithm>
#include "geometry/lattice/seeding.hpp"
#include "plate/bonds/parameters/horizon_parameters.hpp"
#include "plate/bonds/precrack.hpp"
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
  return geometry::bounding_box(problem.outline);
}

/// What lies beyond an edge is expanded from points that must see each other.
void check_cracks(const Problem& problem, const std::vector<geometry::CrackPath>& paths) {
  const double horizon = problem.discretization.horizon();
  for (const auto& path : paths)
    for (const auto& vertex : path.vertices)
      if (const double away = geometry::distance_to_boundary(problem.outline, vertex); away <= horizon)
        refuse(Subject::cracks,
               fmt::format("a crack is {:.3g} away from an edge: surface nodes need more than a horizon, {:.3g}, "
                           "between them: choose boundary = \"images\"{}",
                           away, horizon, away > 1e-9 * horizon ? ", or a smaller spacing" : ""));
}

/// Twist beside free edges and soft supports turns within less than the thickness; expansions of a wider horizon make
/// deflections up to ten times too small there (measured against images: 4 % at most up to 2 thicknesses, 28 % at 3).
void check_horizon(const Problem& problem) {
  const auto stiff = [&](const geometry::Edge& edge) {
    return std::ranges::any_of(problem.supports, [&](const Support& s) {
      return (s.kind == SupportKind::clamped || s.kind == SupportKind::simply_supported_hard) &&
             std::ranges::find(s.edges, edge.name) != s.edges.end();
    });
  };
  const double most = std::ranges::all_of(geometry::straight_edges(problem.outline), stiff) ? 3.1 : 2.1;
  const double thickness = problem.section.thickness, horizon = problem.discretization.horizon();
  if (horizon > most * thickness)
    refuse(
        Subject::spacing,
        fmt::format("the horizon is {:.3g} times the thickness: with surface nodes {:g} at most (3.1 where all edges "
                    "are clamped or hard supported), spacing {:.3g}; or choose boundary = \"images\"",
                    horizon / thickness, most, problem.discretization.spacing * most * thickness / horizon));
}

SurfacePlate plate_of(const Problem& problem, const Point& low, const Point& high) {
  constexpr double least = 0.25;  // spacings: expansions through an edge and a nearer point enlarge what they see
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
  for (const auto& x : b.cloud.positions) b.lattice.push_back(b.cloud.units.to_lattice(x));
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

/// Bonds of the points of the plate among each other; surface nodes have none.
geometry::Families families_of(const Boundary& b, double horizon) {
  geometry::Cloud points = b.cloud;
  points.positions.resize(points.plate_points), points.areas.resize(points.plate_points);
  auto families = geometry::families(points, horizon, [](std::uint32_t, std::uint32_t) { return true; });
  for (std::size_t k = points.plate_points; k < b.cloud.size(); ++k) families.set(k, {});
  return families;
}

/// With a bond from each surface node to its inner node: what holds the one holds the other.
geometry::Families tied(geometry::Families families, const SurfacePlate& plate) {
  for (std::size_t s = 0; s < plate.body.surface.size(); ++s) {
    const int k = plate.body.real + int(s);
    families.set(std::size_t(k), {{plate.body.surface[s].inner - k, 0}});
  }
  return families;
}

}  // namespace

SurfaceLayout surface_layout(const Problem& problem) {
  const auto [low, high] = rectangle_of(problem);
  auto paths = crack_paths(problem);
  check_cracks(problem, paths);
  check_horizon(problem);
  SurfacePlate plate = plate_of(problem, low, high);
  Layout layout{problem, {}, geometry::tips(paths), boundary_of(problem, plate), {}, {}};
  auto& b = layout.boundary;
  const auto in_spacings = geometry::to_lattice(paths, b.cloud.units);
  plate.cuts = CutFamilies(plate.body, plate.bonds, FamilyRule(problem.section, problem.discretization), in_spacings);
  const auto side_of = sides_of_nodes(plate, b);
  hold(plate, side_of, b);
  const auto whole = families_of(b, problem.discretization.horizon());
  auto families = sever(b, whole, in_spacings, problem.discretization.horizon_ratio);
  const auto shapes = bond_shapes(families.vectors(), problem.section, problem.discretization);
  layout.cut = cut_share(whole, families, shapes, b.cloud.plate_points);
  layout.pieces = pieces(b, tied(families, plate));
  for (std::size_t i = 0; i < problem.loads.size(); ++i)
    layout.loads.push_back({forces_of(problem.loads[i], i, plate, b, problem.outline), problem.loads[i].history});
  layout.paths = std::move(paths);
  return {std::move(layout), std::move(plate), std::move(families)};
}

}  // namespace plate
