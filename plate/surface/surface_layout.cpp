#include "plate/surface/surface_layout.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include "geometry/lattice/seeding.hpp"
#include "plate/bonds/parameters/horizon_parameters.hpp"
#include "plate/bonds/precrack.hpp"
#include "plate/model/refused.hpp"
#include "plate/surface/acceptance.hpp"
#include "plate/surface/multiplied_plate.hpp"
#include "plate/surface/rectilinear.hpp"

namespace plate {

namespace {

using geometry::Point;

[[noreturn]] void refuse(Subject subject, std::string what, std::size_t number = 0) {
  throw Refused({{subject, number, std::move(what)}});
}

SurfacePlate plate_of(const Problem& problem) {
  constexpr double least = 0.25;  // spacings: expansions through an edge and a nearer point enlarge what they see
  auto plate = surface_plate(problem.section, problem.discretization, problem.outline);
  const auto [low, high] = geometry::bounding_box(problem.outline);
  for (const auto& face : plate.body.surface)
    if (face.distance < least) {
      const double side = (high - low)[face.axis];
      const double cells = std::round(side / plate.bonds.spacing);
      refuse(Subject::spacing,
             fmt::format("an edge lies {:.2g} spacings beyond a row of points; spacing {:.6g} would put "
                         "those of the bounding box half a spacing beyond",
                         face.distance, side / cells));
    }
  return plate;
}

/// The side with this outward normal that a place on the edges [length] lies on.
std::size_t side_at(const Boundary& b, const Point& at, const Point& normal) {
  const Point u = b.cloud.units.to_units(at);
  std::size_t result = b.sides.size();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < b.sides.size(); ++i) {
    const auto& side = b.sides[i];
    if (side.outward(u).dot(normal) < 0.5) continue;
    const double away = side.circle ? std::abs(side.inside(u)) : geometry::distance({side.edge.from, side.edge.to}, u);
    if (away < least) least = away, result = i;
  }
  return result;
}

/// Of the surface nodes, in their order: the side on which each lies.
std::vector<std::size_t> sides_of_nodes(const SurfacePlate& plate, const Boundary& boundary) {
  std::vector<std::size_t> result;
  for (int s = 0; s < plate.surfaces(); ++s) result.push_back(side_at(boundary, plate.at_surface(s), plate.normal(s)));
  return result;
}

Boundary boundary_of(const Problem& problem, const SurfacePlate& plate, bool multiplied) {
  Boundary b;
  b.cloud = geometry::lattice(problem.outline, problem.discretization.spacing);
  for (int times = multiplied ? 2 : 1; times > 0; --times)
    for (int s = 0; s < plate.surfaces(); ++s) {
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
  const std::size_t fictitious = b.cloud.size() - b.cloud.plate_points;  // multipliers are of the sides of their nodes
  for (std::size_t i = 0; i < fictitious; ++i)
    b.fictitious.push_back({{int(side_of[i % side_of.size()]), -1}, false, false});
  for (std::uint32_t s = 0; s < side_of.size(); ++s) {
    const auto condition = edge_condition(b.sides[side_of[s]].kind);
    const auto first = std::uint32_t(3 * (plate.body.real + int(s)));
    if (plate.oblique) {  // one rotation that is held: a row of the stiffness
      if (condition.held[0]) b.constraints.fix(first);
      for (const std::uint32_t i : {1U, 2U})
        if (condition.held[1] && condition.held[2]) b.constraints.fix(first + i);
      continue;
    }
    const int axis = plate.body.surface[s].axis;
    const int components[] = {0, normal_rotation(axis), tangential_rotation(axis)};
    for (std::size_t i = 0; i < 3; ++i)
      if (condition.held[i]) b.constraints.fix(first + std::uint32_t(components[i]));
  }
  for (std::uint32_t pin = 0; pin < b.holders.size(); ++pin)
    if (const auto& at = b.holders[pin].position) {
      const auto k = std::uint32_t(geometry::nearest_plate_point(b.cloud, *at));
      b.constraints.fix(3 * k);
      b.holds.push_back({k, pin, false});
    }
}

/// The stiffness by a method; by multipliers with the conditions that are left out.
SparseStiffness stiffness_of(const SurfacePlate& plate, EdgeMethod method, Boundary& b) {
  if (plate.oblique) {
    b.constraints.resolve();
    return stiffness_under(plate, [&](const Point& at, const Point& normal) {
      return edge_condition(b.sides[side_at(b, at, normal)].kind);
    });
  }
  if (method == EdgeMethod::surface_nodes) {
    b.constraints.resolve();
    return stiffness_with_reactions(plate, [&](int unknown) { return b.constraints.held(std::uint32_t(unknown)); });
  }
  Constraints conditions = b.constraints;
  conditions.resolve();
  std::vector<char> held;
  for (int i = 3 * plate.body.real; i < plate.unknowns(); ++i) held.push_back(conditions.held(std::uint32_t(i)));
  auto [stiffness, idle] = multiplied_plate(plate, held);
  for (const int one : idle) b.constraints.fix(std::uint32_t(one));
  b.constraints.resolve();
  return stiffness;
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

/// Forces per area at points of the plate, as conditions at edges in any direction say nothing of parts of cells.
geometry::Cloud whole_cells(geometry::Cloud cloud) {
  std::fill_n(cloud.areas.begin(), cloud.plate_points, cloud.units.spacing * cloud.units.spacing);
  return cloud;
}

/// Of a pressure on edges in any direction: what the cells of the points leave out or have too much, on the edges that
/// hold the deflection, so that reactions are those of the whole load.
void add_rest(double pressure, const SurfacePlate& plate, const Boundary& b, const geometry::Outline& outline,
              Forces& forces) {
  std::vector<int> held;
  double around = 0;
  for (int s = 0; s < plate.surfaces(); ++s)
    if (b.constraints.held(std::uint32_t(3 * (plate.body.real + s)))) held.push_back(s), around += plate.length(s);
  const double rest = geometry::area(outline) - plate.body.real * std::pow(plate.bonds.spacing, 2);
  for (const int s : held) forces(0, plate.body.real + s) += pressure * rest * plate.length(s) / around;
}

Forces forces_of(const Load& load, std::size_t number, const SurfacePlate& plate, const Boundary& b,
                 const geometry::Outline& outline) {
  using enum Load::Kind;
  if (load.kind == point_force || load.kind == line_load || load.moves() || (load.kind == pressure && !load.uniform()))
    return nodal_forces(load, plate.oblique ? whole_cells(b.cloud) : b.cloud, outline);
  const double everywhere = load.kind == pressure ? load.value : 0;
  const auto on_edges = [&](const Point& at, const Point& n) {
    const auto& side = b.sides[side_at(b, at, n)];
    const bool loaded = std::ranges::find(load.edges, side.name) != load.edges.end();
    auto condition = edge_condition(side.kind, loaded ? action_of(load, n) : EdgeAction{}, number);
    if (plate.oblique) return condition;
    condition.held = {false, false, false};  // forces on what is held are booked to the supports
    return condition;
  };
  const auto right =
      edge_problem(plate, on_edges, [&](const Point&) { return Eigen::Vector3d(everywhere, 0, 0); }).right;
  Forces forces = Forces::Zero(3, Eigen::Index(b.cloud.size()));
  forces.leftCols(right.size() / 3) = Eigen::Map<const Eigen::Matrix3Xd>(right.data(), 3, right.size() / 3);
  if (plate.oblique) add_rest(everywhere, plate, b, outline, forces);
  return forces;
}

/// A load along an edge acts on the faces of whole cells.
void warn_of_lengths(const Problem& problem, const SurfacePlate& plate, const std::vector<std::size_t>& side_of,
                     Boundary& b) {
  constexpr double close = 0.01;
  if (plate.oblique) return;  // parts of edges are as long as these together
  for (const auto& load : problem.loads)
    for (const auto& name : load.edges) {
      const double length = geometry::edge_length(problem.outline, name);
      const auto faces = std::ranges::count_if(side_of, [&](std::size_t side) { return b.sides[side].name == name; });
      const double more = double(faces) * plate.bonds.spacing / length - 1;
      if (std::abs(more) > close)
        b.warnings.push_back(
            fmt::format("the load on edge {} acts on {} cells of the lattice, {:.2g} % {} than its length, and its sum "
                        "is off by that: take a spacing that divides it",
                        name, faces, 100 * std::abs(more), more > 0 ? "more" : "less"));
    }
}

/// Bonds of the points of the plate among each other; surface nodes have none.
geometry::Families families_of(const Boundary& b, const geometry::Outline& outline, double horizon) {
  geometry::Cloud points = b.cloud;
  points.positions.resize(points.plate_points), points.areas.resize(points.plate_points);
  const bool convex = is_rectilinear(outline) && geometry::straight_edges(outline).size() == 4;
  const auto in_spacings = geometry::to_lattice(outline, b.cloud.units);
  auto families = geometry::families(points, horizon, [&](std::uint32_t k, std::uint32_t j) {
    return convex || !geometry::leaves(in_spacings, b.lattice[k], b.lattice[j]);
  });
  for (std::size_t k = points.plate_points; k < b.cloud.size(); ++k) families.set(k, {});
  return families;
}

/// With a bond from each surface node, and its multipliers, to its inner node: what holds the one holds the other.
geometry::Families tied(geometry::Families families, const SurfacePlate& plate, std::size_t points) {
  const auto real = std::size_t(plate.body.real);
  for (std::size_t k = real; k < points; ++k)
    families.set(k, {{plate.inner(int(k - real) % plate.surfaces()) - int(k), 0}});
  return families;
}

}  // namespace

SurfaceLayout surface_layout(const Problem& problem, EdgeMethod method) {
  auto paths = crack_paths(problem);
  const bool multiplied = method == EdgeMethod::fictitious_nodes;
  check(problem, paths, method);
  SurfacePlate plate = plate_of(problem);
  Layout layout{problem, {}, geometry::tips(paths), boundary_of(problem, plate, multiplied), {}, {}};
  auto& b = layout.boundary;
  const auto in_spacings = geometry::to_lattice(paths, b.cloud.units);
  plate.cuts = CutFamilies(plate.body, plate.bonds, FamilyRule(problem.section, problem.discretization), in_spacings);
  const auto side_of = sides_of_nodes(plate, b);
  hold(plate, side_of, b);
  warn_of_lengths(problem, plate, side_of, b);
  auto stiffness = stiffness_of(plate, method, b);
  const auto whole = families_of(b, problem.outline, problem.discretization.horizon());
  auto families = sever(b, whole, in_spacings, problem.discretization.horizon_ratio);
  const auto shapes = bond_shapes(families.vectors(), problem.section, problem.discretization);
  layout.cut = cut_share(whole, families, shapes, b.cloud.plate_points);
  layout.pieces = pieces(b, tied(families, plate, b.cloud.size()));
  for (std::size_t i = 0; i < problem.loads.size(); ++i)
    layout.loads.push_back({forces_of(problem.loads[i], i, plate, b, problem.outline), problem.loads[i].history});
  layout.paths = std::move(paths);
  return {std::move(layout), std::move(plate), std::move(families), std::move(stiffness)};
}

}  // namespace plate
