#include "plate/edges/surface_layout.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/lattice/cloud.hpp"
#include "plate/bonds/horizon_parameters.hpp"
#include "plate/bonds/loads_in_plane.hpp"
#include "plate/bonds/visibility.hpp"
#include "plate/edges/multiplied_plate.hpp"
#include "plate/edges/outlines.hpp"
#include "plate/formulation/support_constraints.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/space.hpp"

namespace plate {

namespace {

using geometry::Point;

[[noreturn]] void refuse_plate(Subject subject, std::string what) {
  throw Refused({{subject, 0, std::move(what)}});
}

std::string words(EdgeMethod method) {
  return method == EdgeMethod::surface_nodes ? "surface nodes" : "fictitious nodes";
}

std::string place_text(const Point& x) {
  return fmt::format("({:.4g}, {:.4g})", x.x(), x.y());
}

Clearance clearance_of(const Problem& problem) {
  return is_rectilinear(problem.outline) ? clearance(problem.outline)
                                         : oblique_clearance(problem.outline, problem.discretization.spacing);
}

/// Throws Refused for outlines whose edges cannot be served. Values beyond an edge are expanded from points behind it,
/// as far as a horizon, and must not be seen from behind another edge; edges as short as a horizon have too few nodes
/// of their own.
void check_outline(const Problem& problem, EdgeMethod method) {
  const std::string images = ": choose boundary = \"images\"";
  const double spacing = problem.discretization.spacing;
  const bool oblique = !is_rectilinear(problem.outline);
  if (oblique && method == EdgeMethod::fictitious_nodes)
    refuse_plate(Subject::geometry,
                 words(method) +
                     " are of edges along the axes, and of holes of such edges, as expansions beyond them run "
                     "along rows of points" +
                     images + " or \"surface_nodes\"");
  if (const auto shortest = shortest_edge(problem.outline); oblique && shortest.value < spacing / 2)
    refuse_plate(
        Subject::geometry,
        fmt::format("an edge is {:.3g} long at {}: surface nodes, one an edge at least, need half a spacing: take "
                    "fewer edges, or a smaller spacing",
                    shortest.value, place_text(shortest.at)));
  const double horizon = problem.discretization.horizon(), least = horizon * (1 - 1e-9);
  const auto c = clearance_of(problem);
  if (c.gap.value < 2 * least)
    refuse_plate(
        Subject::geometry,
        fmt::format("a hole or notch is {:.3g} wide at {}: {} need two horizons, {:.3g}, between edges that face "
                    "each other",
                    c.gap.value, place_text(c.gap.at), words(method), 2 * horizon) +
            images + ", or a smaller spacing");
  if (c.step.value < least)
    refuse_plate(Subject::geometry,
                 fmt::format("an edge is {:.3g} long at {}: {} need a horizon, {:.3g}, between two corners",
                             c.step.value, place_text(c.step.at), words(method), horizon) +
                     images + ", or a smaller spacing");
}

/// Throws Refused for loads in the plane, symmetry supports and edge loads on plates with oblique edges. Conditions on
/// oblique edges are those of the local plate and of whole cells: deflections under loads on them did not converge, and
/// rotations held alone there give reaction moments that are wrong by a third.
void check_oblique(const Problem& problem) {
  if (is_rectilinear(problem.outline)) return;
  const std::string instead =
      " does not converge with surface nodes where edges are oblique to the lattice: choose boundary = \"images\" or "
      "formulation = \"galerkin\"";
  if (problem.section.law == PlateLaw::membrane)
    throw Refused(
        {{Subject::edge_method, 0,
          "loads in the plane need edges along the axes with surface nodes: choose \"images\", or formulation "
          "= \"galerkin\""}});
  for (std::size_t k = 0; k < problem.supports.size(); ++k)
    if (problem.supports[k].kind == SupportKind::symmetry) throw Refused({{Subject::support, k, "symmetry" + instead}});
  for (std::size_t k = 0; k < problem.loads.size(); ++k)
    if (!problem.loads[k].edges().empty()) throw Refused({{Subject::load_edges, k, "a load on an edge" + instead}});
}

/// Throws Refused for cracks within a horizon of an edge: values beyond an edge are expanded from points that must see
/// each other.
void check_cracks(const Problem& problem, const std::vector<geometry::CrackPath>& paths, EdgeMethod method) {
  const double horizon = problem.discretization.horizon();
  for (const auto& path : paths)
    for (const auto& vertex : path.vertices)
      if (const double away = geometry::distance_to_boundary(problem.outline, vertex); away <= horizon)
        refuse_plate(Subject::cracks,
                     fmt::format("a crack is {:.3g} away from an edge: {} need more than a horizon, {:.3g}, "
                                 "between them: choose boundary = \"images\"{}",
                                 away, words(method), horizon, away > 1e-9 * horizon ? ", or a smaller spacing" : ""));
}

/// Largest ratios of the horizon to the thickness and to the narrowest part of the plate.
struct Widest {
  double thickness, side;
};

/// Twist beside free edges and soft supports turns within less than the thickness; expansions of a wider horizon make
/// deflections too small there. Measured against images and the local plate, squares with 29 kinds of support and load:
/// with surface nodes 4 % at most up to 2 thicknesses, 28 % at 3; with multipliers 5 % at most within these limits, 6
/// to 11 % at free edges with 0.075 to 0.15 of the side or soft ones at 1.5 thicknesses, 20 % and more at 3. Edges in
/// any direction, some of them free, have motions that grow at 1.5 and 2 thicknesses, and none up to 1.
Widest widest(const Problem& problem, EdgeMethod method) {
  const auto edges = geometry::edge_names(problem.outline);
  const auto kind = [&](const std::string& edge) {
    for (const auto& one : problem.supports)
      if (!one.holds_nothing() && std::ranges::find(one.edges, edge) != one.edges.end()) return one.kind;
    return SupportKind::free;
  };
  const auto stiff = [&](const std::string& edge) {
    const auto is = kind(edge);
    return is == SupportKind::clamped || is == SupportKind::simply_supported_hard ||
           (is == SupportKind::symmetry && method == EdgeMethod::fictitious_nodes);
  };
  const auto free = [&](const std::string& edge) { return kind(edge) == SupportKind::free; };
  const bool all_stiff = std::ranges::all_of(edges, stiff);
  if (method == EdgeMethod::surface_nodes) {
    const bool oblique = !is_rectilinear(problem.outline);
    return {all_stiff ? 3.1 : oblique && std::ranges::any_of(edges, free) ? 1.0 : 2.1, 1};
  }
  if (all_stiff) return {3.1, 0.16};
  return {0.75, std::ranges::any_of(edges, free) ? 0.061 : 0.101};
}

void check_horizon(const Problem& problem, EdgeMethod method) {
  if (problem.section.law == PlateLaw::membrane) return;  // no layer beside edges; the plate that bends is checked
  const auto [of_thickness, of_side] = widest(problem, method);
  const double thickness = problem.section.thickness, side = clearance_of(problem).width.value;
  const double horizon = problem.discretization.horizon(),
               most = std::min(of_thickness * thickness, of_side * side) * (1 + 1e-9);
  if (horizon <= most) return;
  refuse_plate(
      Subject::spacing,
      fmt::format(
          "the horizon is {:.3g} times the thickness and {:.2g} of the narrowest part of the plate; {} here allow {:g} "
          "and {:g}: choose spacing = {:.3g}, or boundary = \"images\"",
          horizon / thickness, horizon / side, words(method), of_thickness, of_side,
          problem.discretization.spacing * most / horizon));
}

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

/// Side on which each surface node lies, in the order of the surface nodes.
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
  for (std::uint32_t k = 0; problem.section.law == PlateLaw::membrane && k < b.cloud.size(); ++k)
    b.constraints.fix(dof(k, 0));
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
    const auto node = std::uint32_t(plate.body.real) + s;
    if (plate.oblique) {  // one rotation that is held: a row of the stiffness
      if (condition.held[0]) b.constraints.fix(dof(node, 0));
      for (const std::uint32_t i : {1U, 2U})
        if (condition.held[1] && condition.held[2]) b.constraints.fix(dof(node, i));
      continue;
    }
    const int axis = plate.body.surface[s].axis;
    const int components[] = {0, normal_rotation(axis), tangential_rotation(axis)};
    for (std::size_t i = 0; i < unknowns_per_point; ++i)
      if (condition.held[i]) b.constraints.fix(dof(node, components[i]));
  }
  for (std::uint32_t pin = 0; pin < b.holders.size(); ++pin)
    if (const auto& at = b.holders[pin].position) {
      const auto k = std::uint32_t(geometry::nearest_plate_point(b.cloud, *at));
      const auto held = held_at_point(b.holders[pin].kind);  // more than the deflection of a membrane alone
      for (const auto c : held) b.constraints.fix(dof(k, c));
      b.holds.push_back({k, pin, held.size() > 1});
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
    return stiffness_with_reactions(plate, [&](int unknown) { return b.constraints.held(dof_by_points(unknown)); });
  }
  Constraints conditions = b.constraints;
  conditions.resolve();
  std::vector<char> held;
  for (int i = unknowns_per_point * plate.body.real; i < plate.unknowns(); ++i)
    held.push_back(conditions.held(dof_by_points(i)));
  auto [stiffness, idle] = multiplied_plate(plate, held);
  for (const int one : idle) b.constraints.fix(dof_by_points(one));
  b.constraints.resolve();
  return stiffness;
}

/// Forces in the plane on an edge with this normal, as moments (PlateLaw::membrane), as far as nothing holds it.
EdgeAction action_of(const EdgeTraction& load, const Point& n, SupportKind kind) {
  const auto held = held_by(kind);
  const Point force = load.on(n);
  EdgeAction action;
  if (!held.normal) action.moment = force.dot(n);
  if (!held.tangential) action.twisting_moment = force.dot(Point(-n.y(), n.x()));
  return action;
}

/// Action of a load on an edge with this normal.
EdgeAction action_of(const Load& load, const Point& n, SupportKind kind) {
  EdgeAction action;
  if (const auto* traction = load.as<EdgeTraction>()) return action_of(*traction, n, kind);
  const auto given = [](double value) { return value == 0 ? std::nullopt : std::optional(value); };
  if (const auto* shear = load.as<EdgeShear>()) action.shear = given(shear->value);
  const auto* edge = load.as<EdgeMoment>();
  if (!edge) return action;
  action.moment = given(edge->value), action.twisting_moment = given(edge->twist);
  if (!edge->tensor) return action;
  const Point moment = edge->on(n);
  action.moment = given(moment.dot(n)), action.twisting_moment = given(moment.dot(Point(-n.y(), n.x())));
  return action;
}

/// Forces per area at points of the plate, as conditions at edges in any direction say nothing of parts of cells.
geometry::Cloud with_full_cells(geometry::Cloud cloud) {
  std::fill_n(cloud.areas.begin(), cloud.plate_points, cloud.units.spacing * cloud.units.spacing);
  return cloud;
}

/// Adds the part of a pressure that the cells of the points leave out, or have too much of, where edges run in any
/// direction. It is put on the edges that hold the deflection, so that reactions are those of the whole load.
void add_rest(double pressure, const SurfacePlate& plate, const Boundary& b, const geometry::Outline& outline,
              Forces& forces) {
  std::vector<int> held;
  double around = 0;
  for (int s = 0; s < plate.surfaces(); ++s)
    if (b.constraints.held(dof(plate.body.real + s, 0))) held.push_back(s), around += plate.length(s);
  const double rest = geometry::area(outline) - plate.body.real * std::pow(plate.bonds.spacing, 2);
  for (const int s : held) forces(0, plate.body.real + s) += pressure * rest * plate.length(s) / around;
}

/// Nodal forces of load `number`: of a membrane those of loads in the plane, of a plate that bends those of all others.
Forces forces_of(const Problem& problem, std::size_t number, const SurfacePlate& plate, const Boundary& b,
                 const std::vector<geometry::CrackPath>& paths) {
  const Load& load = problem.loads[number];
  const auto& outline = problem.outline;
  const bool in_plane = problem.section.law == PlateLaw::membrane;
  if (in_plane && load.as<PointForce>())
    return forces_in_plane(load, b, outline, paths, problem.discretization.horizon_ratio);
  if (!in_plane && (load.as<EdgeTraction>() || load.as<BodyForce>())) return zero_forces(b.cloud.size());
  const auto* pressure = load.as<Pressure>();
  if (load.as<PointForce>() || load.as<LineLoad>() || load.moves() || (pressure && !pressure->uniform()))
    return nodal_forces(load, plate.oblique ? with_full_cells(b.cloud) : b.cloud, outline);
  PointValues everywhere(pressure ? pressure->value : 0, 0, 0);
  if (const auto* body = load.as<BodyForce>()) everywhere = PointValues(0, -body->vector.y(), body->vector.x());
  const auto on_edges = [&](const Point& at, const Point& n) {
    const auto& side = b.sides[side_at(b, at, n)];
    const bool loaded = std::ranges::find(load.edges(), side.name) != load.edges().end();
    auto condition = edge_condition(side.kind, loaded ? action_of(load, n, side.kind) : EdgeAction{}, number);
    if (plate.oblique) return condition;
    condition.held = {false, false, false};  // forces on constrained degrees of freedom count as the supports'
    return condition;
  };
  const auto right = edge_problem(plate, on_edges, [&](const Point&) { return everywhere; }).right;
  Forces forces = zero_forces(b.cloud.size());
  const Eigen::Index nodes = right.size() / unknowns_per_point;
  forces.leftCols(nodes) = Eigen::Map<const StateByPoints>(right.data(), unknowns_per_point, nodes);
  if (plate.oblique) add_rest(everywhere[0], plate, b, outline, forces);
  return forces;
}

/// A load along an edge acts on the faces of whole cells.
void warn_of_lengths(const Problem& problem, const SurfacePlate& plate, const std::vector<std::size_t>& side_of,
                     Boundary& b) {
  constexpr double close = 0.01;
  if (plate.oblique) return;  // parts of edges are as long as these together
  for (const auto& load : problem.loads)
    for (const auto& name : load.edges()) {
      const double length = geometry::edge_length(problem.outline, name);
      const auto faces = std::ranges::count_if(side_of, [&](std::size_t side) { return b.sides[side].name == name; });
      const double more = double(faces) * plate.bonds.spacing / length - 1;
      if (std::abs(more) > close)
        b.warnings.push_back(
            fmt::format("the load on edge {} acts on {} cells of the lattice, {:.2g} % {} than its length; set "
                        "`spacing` = {:.6g}",
                        name, faces, 100 * std::abs(more), more > 0 ? "more" : "less",
                        length / std::max(1.0, std::round(length / plate.bonds.spacing))));
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

/// Returns families with a bond from each surface node, and its multipliers, to its inner node: what holds the one
/// holds the other.
geometry::Families tied(geometry::Families families, const SurfacePlate& plate, std::size_t points) {
  const auto real = std::size_t(plate.body.real);
  for (std::size_t k = real; k < points; ++k)
    families.set(k, {{plate.inner(int(k - real) % plate.surfaces()) - int(k), 0}});
  return families;
}

}  // namespace

void check(const Problem& problem, const std::vector<geometry::CrackPath>& paths, EdgeMethod method) {
  check_outline(problem, method);
  if (method == EdgeMethod::surface_nodes) check_oblique(problem);
  check_cracks(problem, paths, method);
  check_horizon(problem, method);
}

SurfaceLayout surface_layout(const Problem& problem, EdgeMethod method) {
  auto paths = crack_paths(problem);
  const bool multiplied = method == EdgeMethod::fictitious_nodes;
  check(problem, paths, method);
  SurfacePlate plate = plate_of(problem);
  Layout layout{problem, {}, geometry::tips(paths), boundary_of(problem, plate, multiplied), {}, {}};
  auto& b = layout.boundary;
  const auto in_spacings = geometry::to_lattice(paths, b.cloud.units);
  plate.cuts =
      CrackedFamilies(plate.body, plate.bonds, FamilyRule(problem.section, problem.discretization), in_spacings);
  const auto side_of = sides_of_nodes(plate, b);
  hold(plate, side_of, b);
  warn_of_lengths(problem, plate, side_of, b);
  auto stiffness = stiffness_of(plate, method, b);
  const auto whole = families_of(b, problem.outline, problem.discretization.horizon());
  auto families = without_crossing_bonds(b, whole, in_spacings, problem.discretization.horizon_ratio);
  const auto shapes = bond_shapes(families.vectors(), problem.section, problem.discretization);
  layout.cut = cut_share(whole, families, shapes, b.cloud.plate_points);
  layout.pieces = pieces(b, tied(families, plate, b.cloud.size()), problem.section.law);
  for (std::size_t i = 0; i < problem.loads.size(); ++i)
    layout.loads.push_back({forces_of(problem, i, plate, b, paths), problem.loads[i].history});
  layout.paths = std::move(paths);
  return {std::move(layout), std::move(plate), std::move(families), std::move(stiffness)};
}

}  // namespace plate
