#include "plate/model/problem_validation.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <map>

#include "geometry/shape/crack_path.hpp"
#include "geometry/shape/patch.hpp"
#include "plate/model/membrane.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/numerical_method.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/support_validation.hpp"
#include "plate/model/supports.hpp"
#include "plate/model/wording.hpp"

namespace plate {
namespace {

/// True where the name stands for straight edges parallel to the axes only.
bool axis_parallel(const geometry::Outline& outline, const std::string& name) {
  for (const auto& hole : outline.holes)
    if (const auto* circle = std::get_if<geometry::Circle>(&hole); circle && circle->name == name) return false;
  for (const geometry::Edge& edge : geometry::straight_edges(outline))
    if (edge.name == name && (edge.to - edge.from).cwiseAbs().minCoeff() > geometry::tolerance(outline)) return false;
  return true;
}

constexpr auto in_a_layer = ": boundary = \"layer\" holds it in a layer; choose \"images\"";

bool needs_axis_parallel(SupportKind kind) {
  return kind == SupportKind::symmetry || kind == SupportKind::simply_supported_hard || is_layer(kind);
}

/// True of displacements in the plane that edges hold along their normal or tangent alone, where loads act there.
bool one_way_in_plane(const Support& support, const Problem& problem) {
  return (support.in_plane == InPlane::normal || support.in_plane == InPlane::tangential) && has_plane(problem);
}

void check_names(const std::vector<std::string>& names, const std::vector<std::string>& existing, Subject subject,
                 std::size_t number, std::vector<Refusal>& found) {
  for (const auto& name : names)
    if (std::find(existing.begin(), existing.end(), name) == existing.end())
      found.push_back({subject, number,
                       fmt::format("the plate has no edge \"{}\"{}; its edges: {}", name, did_you_mean(name, existing),
                                   listed(existing))});
}

/// True where a part of one line lies on the other. A place where they merely cross does not count.
bool lies_along(const geometry::Polyline& a, const geometry::Polyline& b, double tolerance) {
  constexpr int places = 16;
  const auto on = [&](const geometry::Polyline& line, const geometry::Polyline& other) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      int count = 0;
      for (int n = 0; n < places; ++n)
        count += geometry::distance(other, line[i] + (n + 0.5) / places * (line[i + 1] - line[i])) < tolerance;
      if (count > 1) return true;
    }
    return false;
  };
  return on(a, b) || on(b, a);
}

/// A line without length, or along a crack, where nobody knows which face it acts on. `refusal`: what it would be.
void check_line(const geometry::Polyline& along, Refusal refusal, const Problem& problem, std::vector<Refusal>& found) {
  const double tolerance = 1e3 * geometry::tolerance(problem.outline);
  const auto say = [&](const std::string& what) {
    refusal.what = what;
    found.push_back(refusal);
  };
  if (along.empty()) return;
  if (geometry::length(along) < tolerance) say("the line has no length");
  for (std::size_t i = 0; i < problem.cracks.size(); ++i)
    if (lies_along(along, problem.cracks[i], tolerance))
      say(fmt::format("the line lies along crack {}: move it to the face that it loads", i));
}

/// A patch that misses the plate, unless it moves, or whose boundary crosses itself. `refusal`: what it would be, "the
/// pressure acts".
void check_patch(const std::optional<geometry::Hole>& shape, const Refusal& refusal, const geometry::Outline& outline,
                 std::vector<Refusal>& found, bool moves = false) {
  const auto say = [&](const std::string& what) { found.push_back({refusal.subject, refusal.number, what}); };
  const auto* circle = shape ? std::get_if<geometry::Circle>(&*shape) : nullptr;
  if (circle && !(circle->radius > 0)) {
    say(fmt::format("radius {:g} given, must be > 0", circle->radius));
  } else if (shape) {
    const geometry::Patch patch(*shape);
    const geometry::Polygon ring{patch.ring(), std::vector<std::string>(patch.ring().size())};
    const auto errors = geometry::errors({ring, {}});
    for (const auto& one : errors) say(fmt::format("the polygon that {} on: {}", refusal.what, one.what));
    if (errors.empty() && !moves && !patch.meets(outline)) say(refusal.what + " on nothing of the plate");
  }
}

/// A line that leaves the plate.
void check_along(const geometry::Polyline& along, const Refusal& refusal, const geometry::Outline& outline,
                 std::vector<Refusal>& found) {
  const auto say = [&](const std::string& what) { found.push_back({refusal.subject, refusal.number, what}); };
  for (std::size_t i = 0; i < along.size(); ++i) {
    const auto& x = along[i];
    if (!on_plate(outline, x))
      say(text_of(x) + " given, must lie in the plate or on its boundary");
    else if (i > 0 && on_plate(outline, along[i - 1]) && geometry::leaves(outline, along[i - 1], x))
      say(fmt::format("the line from {} to {} leaves the plate", text_of(along[i - 1]), text_of(x)));
  }
}

/// A load on an edge that holds all it acts on: the support takes it, and points beside the edge a part of it.
void check_held(const Load& load, std::size_t number, const Problem& problem, std::vector<Refusal>& found) {
  const auto* edge_moment = load.as<EdgeMoment>();
  const auto* traction = load.as<EdgeTraction>();
  const bool shear = load.as<EdgeShear>() != nullptr;
  const bool moment = (edge_moment && (edge_moment->tensor || edge_moment->value != 0)) ||
                      (traction && (traction->tensor || traction->value != 0)),
             twist = (edge_moment && (edge_moment->tensor || edge_moment->twist != 0)) ||
                     (traction && (traction->tensor || traction->shear != 0));
  for (const auto& edge : load.edges())
    for (std::size_t i = 0; i < problem.supports.size(); ++i) {
      const auto& support = problem.supports[i];
      if (std::ranges::find(support.edges, edge) == support.edges.end()) continue;
      if (traction && (traction->tensor || traction->shear == 0) && support.kind == SupportKind::hub &&
          support.held_in_plane() == InPlane::free)
        found.push_back(
            {Subject::load_edges, number,
             fmt::format("edge \"{}\" is the rim of a free hub, which an even traction does not move: remove "
                         "it, or give shear",
                         edge)});
      const auto held = traction ? held_in_plane(support.held_in_plane()) : held_by(support.kind);
      if (shear ? held.w : (moment || twist) && (!moment || held.normal) && (!twist || held.tangential))
        found.push_back(
            {Subject::load_edges, number,
             fmt::format("edge \"{}\" is held by `support {}` against all that this load does there: it would "
                         "go into the support and not into the plate",
                         edge, i)});
    }
}

/// A force on a crack, where nobody knows on which face it acts, or on a part that does not move.
void check_force(const Load& load, std::size_t number, const Problem& problem, std::vector<Refusal>& found) {
  const auto position = load.point();
  if (!position) return;
  for (std::size_t i = 0; i < problem.cracks.size(); ++i)
    if (geometry::distance(problem.cracks[i], *position) < 1e3 * geometry::tolerance(problem.outline))
      found.push_back(
          {Subject::load_position, number,
           fmt::format("{} given, lies on crack {}: move it to the face that it loads", text_of(*position), i)});
  for (std::size_t i = 0; i < problem.supports.size(); ++i) {
    const auto& support = problem.supports[i];
    const auto& force = *load.as<PointForce>();
    const auto holds = [&](InPlane axis) {
      return support.held_in_plane() == InPlane::fixed || support.held_in_plane() == axis;
    };
    const bool across = (force.value != 0 || !load.in_plane()) && !support.holds_nothing(),
               along = (force.vector.x() != 0 && holds(InPlane::x)) || (force.vector.y() != 0 && holds(InPlane::y));
    if (!support.patch || !(across || along)) continue;
    const auto ring = geometry::Patch(*problem.supports[i].patch).ring();
    if (geometry::contains({{ring, std::vector<std::string>(ring.size())}, {}}, *position))
      found.push_back(
          {Subject::load_position, number,
           fmt::format("{} given, lies on the part that `support {}` holds: it would go into the support and "
                       "not into the plate",
                       text_of(*position), i)});
  }
}

/// Adds refusals of a hub: it is round, and a rigid body in the plane.
void check_hub(const Problem& problem, std::size_t i, std::vector<Refusal>& found) {
  const auto& support = problem.supports[i];
  const auto round = [&](const std::string& edge) {
    return std::ranges::any_of(problem.outline.holes, [&](const geometry::Hole& hole) {
      const auto* circle = std::get_if<geometry::Circle>(&hole);
      return circle && circle->name == edge;
    });
  };
  const auto existing = geometry::edge_names(problem.outline);
  for (const auto& edge : support.edges)
    if (!round(edge) && std::ranges::find(existing, edge) != existing.end())
      found.push_back({Subject::support_edges, i,
                       fmt::format("\"{}\" is no round hole, which a hub would fill: give holes of circles", edge)});
  if (support.patch && !std::holds_alternative<geometry::Circle>(*support.patch))
    found.push_back({Subject::support_patch, i, "a hub is round: give on = { circle = [x, y, radius] }"});
  if (const auto* disc = support.patch ? std::get_if<geometry::Circle>(&*support.patch) : nullptr)
    if (std::ranges::all_of(problem.outline.outer.vertices,
                            [&](const geometry::Point& x) { return (x - disc->centre).norm() <= disc->radius; }))
      found.push_back({Subject::support_patch, i, "the disc covers the whole plate: give a smaller radius"});
  if (support.holds_one_way())
    found.push_back({Subject::support_in_plane, i, "a hub moves as one body: choose \"fixed\" or \"free\""});
  if (support.patch && support.k_phi && problem.stretches)
    found.push_back({Subject::support_patch, i,
                     "large deflections would stretch the plate within a disc that turns: give a hole of this circle "
                     "and edges, or remove k_phi"});
}

/// Places within the plate that a support holds, of which it has one kind, or edges.
void check_places(const Problem& problem, std::size_t i, std::vector<Refusal>& found) {
  const auto& support = problem.supports[i];
  const bool inside = support.kind == SupportKind::pinned || support.kind == SupportKind::clamped ||
                      support.kind == SupportKind::in_plane;
  const int places = !support.edges.empty() + !support.points.empty() + !support.along.empty() + bool(support.patch);
  if (places != 1)
    found.push_back({Subject::support_edges, i,
                     std::string(places == 0 ? "nothing is held: give " : "several are given, must be one of ") +
                         (support.kind == SupportKind::hub      ? "edges or on"
                          : !inside                             ? "edges"
                          : support.kind == SupportKind::pinned ? "points, along or on"
                                                                : "edges, points, along or on")});
  for (const auto& point : support.points)
    if (!on_plate(problem.outline, point))
      found.push_back(
          {Subject::support_points, i, text_of(point) + " given, must lie in the plate or on its boundary"});
  for (const auto& point : support.points)
    for (std::size_t c = 0; c < problem.cracks.size(); ++c)
      if (support.held_in_plane() != InPlane::free &&
          geometry::distance(problem.cracks[c], point) < 1e3 * geometry::tolerance(problem.outline))
        found.push_back({Subject::support_points, i,
                         fmt::format("{} given, lies on crack {}: held in the plane it would tie both faces together",
                                     text_of(point), c)});
  if (support.kind == SupportKind::in_plane && support.held_in_plane() == InPlane::free)
    found.push_back({Subject::support_in_plane, i, "\"free\" holds nothing: remove the support, or hold something"});
  const bool by_edge = support.in_plane == InPlane::normal || support.in_plane == InPlane::tangential;
  const bool by_axis = support.in_plane == InPlane::x || support.in_plane == InPlane::y;
  if (support.kind == SupportKind::hub)
    check_hub(problem, i, found);
  else if (by_edge && support.edges.empty())
    found.push_back(
        {Subject::support_in_plane, i, "edges alone have a normal: choose \"x\", \"y\", \"fixed\" or \"free\""});
  else if (by_axis && !support.edges.empty())
    found.push_back({Subject::support_in_plane, i,
                     "edges are held along themselves: choose \"normal\", \"tangential\", \"fixed\" or \"free\""});
  check_along(support.along, {Subject::support_line, i, ""}, problem.outline, found);
  check_line(support.along, {Subject::support_line, i, ""}, problem, found);
  check_patch(support.patch, {Subject::support_patch, i, "the support lies"}, problem.outline, found);
  const auto method = problem.discretization.boundary;
  const bool clamps = support.kind == SupportKind::clamped && !support.points.empty();
  if ((support.holds_inside() || clamps) &&
      (method == EdgeMethod::surface_nodes || method == EdgeMethod::fictitious_nodes))
    found.push_back({Subject::edge_method, 0,
                     "nodes at edges have no lines, parts and clamped points that are held: choose \"images\""});
}

/// True where nothing is held that layers, which the discretisation asks for, would hold.
bool layers_in_vain(const Problem& problem, const std::vector<Support>& resolved) {
  return problem.discretization.boundary == EdgeMethod::layer &&
         problem.discretization.formulation->offers(Feature::surface_nodes) &&
         std::ranges::none_of(resolved, [](const Support& support) { return is_layer(support.kind); });
}

/// Refuses edges with the names that reactions of pins, lines, parts and hubs have: pin0, line0, part0, hub0, ...
void check_names_of_reactions(const Problem& problem, std::vector<Refusal>& found) {
  std::map<std::string, std::size_t> counts;
  for (const auto& support : problem.supports) {
    counts["pin"] += support.points.size();
    counts["line"] += !support.along.empty();
    if (support.patch) ++counts[support.kind == SupportKind::hub ? "hub" : "part"];
  }
  const auto edges = geometry::edge_names(problem.outline);
  for (const auto& [word, count] : counts)
    for (std::size_t i = 0; i < count; ++i)
      if (const auto name = fmt::format("{}{}", word, i); std::ranges::find(edges, name) != edges.end())
        found.push_back(
            {Subject::geometry, 0,
             fmt::format("edge \"{}\" has the name of the reaction of a {}: give it another one", name, word)});
}

void check_supports(const Problem& problem, std::vector<Refusal>& found) {
  check_names_of_reactions(problem, found);
  const auto existing = geometry::edge_names(problem.outline);
  const auto supports = resolved_supports(problem);
  std::map<std::string, std::size_t> holder;
  if (layers_in_vain(problem, supports))
    found.push_back({Subject::edge_method, 0,
                     "no edge is clamped or simply supported: a layer would hold nothing; choose \"images\""});
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const auto& support = supports[i];
    check_names(support.edges, existing, Subject::support_edges, i, found);
    for (const auto& edge : support.edges) {
      const auto [first, fresh] = holder.emplace(edge, i);
      if (!fresh && first->second != i)
        found.push_back({Subject::support_edges, i,
                         fmt::format("edge \"{}\" is already held by `support {}`", edge, first->second)});
      const bool any_direction = problem.discretization.formulation->offers(Feature::any_direction) ||
                                 problem.discretization.boundary == EdgeMethod::surface_nodes;
      const bool mirrors = needs_axis_parallel(support.kind) || one_way_in_plane(support, problem);
      if (!any_direction && mirrors && !axis_parallel(problem.outline, edge))
        found.push_back({Subject::support_direction, i,
                         fmt::format("edge \"{}\" is not a straight line parallel to x or y, which this kind "
                                     "of support needs because it mirrors or extends the lattice there{}",
                                     edge, support.kind == problem.supports[i].kind ? "" : in_a_layer)});
    }
    check_places(problem, i, found);
  }
}

/// A table that says nothing of a part of what it acts on.
void check_table(const Pressure& load, std::size_t number, const geometry::Outline& outline,
                 std::vector<Refusal>& found) {
  auto corners = load.patch ? geometry::Patch(*load.patch).ring() : outline.outer.vertices;
  if (load.patch && std::ranges::all_of(outline.outer.vertices, [&](const auto& x) { return load.table.reaches(x); }))
    return;
  for (const auto& x : corners)
    if (!load.table.reaches(x)) {
      found.push_back({Subject::load_table, number,
                       fmt::format("the places of {} do not reach {}, where the pressure acts",
                                   load.table.file().filename().string(), text_of(x))});
      return;
    }
}

/// True where a load that moves along a path acts on the plate anywhere.
bool crosses_plate(const Load& load, const geometry::Outline& outline) {
  constexpr double close = 0.005, most = 1e6;  // places on a piece: a share of the plate apart, and their number
  const auto& path = load.path();
  const auto* pressure = load.as<Pressure>();
  const auto [low, high] = geometry::bounding_box(outline);
  const double side = (high - low).minCoeff();
  const auto far = [&](const geometry::Hole& shape) {
    const auto ring = geometry::Patch(shape).ring();
    const auto beyond = [&](int axis) {
      return std::ranges::all_of(ring, [&](const auto& x) { return x[axis] < low[axis]; }) ||
             std::ranges::all_of(ring, [&](const auto& x) { return x[axis] > high[axis]; });
    };
    return beyond(0) || beyond(1);
  };
  const auto acts_at = [&](const geometry::Point& x) {
    if (!pressure || !pressure->patch) return on_plate(outline, x);
    const auto shape = geometry::moved(*pressure->patch, x - path.front());
    return !far(shape) && geometry::Patch(shape).meets(outline);
  };
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const geometry::Point way = path[i + 1] - path[i];
    const int places = std::max(1, int(std::min(most, std::ceil(way.norm() / (close * side)))));
    for (int n = 0; n <= places; ++n)
      if (acts_at(path[i] + way * n / places)) return true;
  }
  return false;
}

void check_place(const Load& load, std::size_t number, const geometry::Outline& outline, std::vector<Refusal>& found) {
  const auto* pressure = load.as<Pressure>();
  if (pressure)
    check_patch(pressure->patch, {Subject::load_patch, number, "the pressure acts"}, outline, found, load.moves());
  check_along(load.line(), {Subject::load_line, number, ""}, outline, found);
  const auto say = [&](Subject subject, const std::string& what) { found.push_back({subject, number, what}); };
  if (load.moves() && geometry::length(load.path()) < geometry::tolerance(outline))
    say(Subject::load_path, "the path has no length");
  else if (load.moves() && !crosses_plate(load, outline))
    say(Subject::load_path, "the path does not cross the plate");
  if (load.moves() && pressure) {
    if (!pressure->patch)
      say(Subject::load_path, "a pressure that moves needs a part of the plate to begin with: give on");
    if (pressure->evaluated() || pressure->level || !pressure->gradient.isZero(0))
      say(Subject::load_path, "a pressure that moves has a value alone: remove what makes it vary");
  }
  if (pressure && pressure->table.given()) check_table(*pressure, number, outline, found);
}

}  // namespace

bool on_plate(const geometry::Outline& outline, const geometry::Point& point) {
  return geometry::contains(outline, point) ||
         geometry::distance_to_boundary(outline, point) <= geometry::tolerance(outline);
}

std::vector<Refusal> errors_in_edges(const Problem& problem) {
  std::vector<Refusal> found;
  check_supports(problem, found);
  for (const auto& refusal : errors_in_settlements(problem)) found.push_back(refusal);
  for (std::size_t i = 0; i < problem.loads.size(); ++i) {
    const auto& load = problem.loads[i];
    check_names(load.edges(), geometry::edge_names(problem.outline), Subject::load_edges, i, found);
    if (const auto position = load.point(); position && !geometry::contains(problem.outline, *position))
      found.push_back({Subject::load_position, i, text_of(*position) + " given, must lie inside the plate"});
    check_place(load, i, problem.outline, found);
    check_line(load.line(), {Subject::load_line, i, ""}, problem, found);
    check_held(load, i, problem, found);
    check_force(load, i, problem, found);
  }
  for (std::size_t i = 0; i < problem.foundations.size(); ++i)
    if (problem.foundations[i].unilateral && problem.foundations[i].shear > 0)
      found.push_back(
          {Subject::foundation, i, "a shear layer holds the plate where it lifts off: remove shear or lifts_off"});
  for (std::size_t i = 0; i < problem.foundations.size(); ++i)
    check_patch(problem.foundations[i].patch, {Subject::foundation_patch, i, "the foundation lies"}, problem.outline,
                found);
  for (std::size_t i = 0; i < problem.section.regions.size(); ++i)
    check_patch(problem.section.regions[i].shape, {Subject::region_shape, i, "the region lies"}, problem.outline,
                found);
  for (std::size_t i = 0; i < problem.stiffeners.size(); ++i) {
    const auto& beam = problem.stiffeners[i];
    check_names(beam.edges, geometry::edge_names(problem.outline), Subject::stiffener_edges, i, found);
    check_along(beam.along, {Subject::stiffener_line, i, ""}, problem.outline, found);
    check_line(beam.along, {Subject::stiffener_line, i, ""}, problem, found);
  }
  for (std::size_t i = 0; i < problem.springs.size(); ++i) {
    const auto& spring = problem.springs[i];
    check_names(spring.edges, geometry::edge_names(problem.outline), Subject::spring_edges, i, found);
    check_along(spring.along, {Subject::spring_line, i, ""}, problem.outline, found);
    check_line(spring.along, {Subject::spring_line, i, ""}, problem, found);
    for (const auto crack : spring.cracks)
      if (crack >= problem.cracks.size())
        found.push_back({Subject::spring_cracks, i,
                         problem.cracks.empty()
                             ? std::string("there are no cracks whose faces springs could tie")
                             : fmt::format("{} given, must be from 0 to {}", crack, problem.cracks.size() - 1)});
    if (spring.position && !on_plate(problem.outline, *spring.position))
      found.push_back({Subject::spring_position, i,
                       text_of(*spring.position) + " given, must lie in the plate or on its boundary"});
  }
  for (const auto& refusal : errors_in_springs(problem)) found.push_back(refusal);
  return found;
}

std::vector<Refusal> errors_in_heat(const Problem& problem) {
  std::vector<Refusal> found;
  if (!heated(problem)) return found;
  const auto refuse = [&](Subject subject, const std::string& what, std::size_t number = 0) {
    found.push_back({subject, number, what});
  };
  const auto& plies = problem.section.plies;
  const auto expands = [](const Ply& ply) { return ply.alpha1 && ply.alpha2; };
  if (problem.section.thermal_expansion == 0 && (plies.empty() || !std::ranges::all_of(plies, expands)))
    refuse(Subject::thermal_expansion, "is missing, must be a number > 0: temperatures strain the plate by it");
  if (!problem.section.uniform())
    refuse(Subject::section, "temperatures are of plates of one material and one thickness all over");
  const auto& d = problem.discretization;
  const bool of_bonds = d.formulation && d.formulation->offers(Feature::horizon);
  if (of_bonds && d.boundary != EdgeMethod::images)
    refuse(Subject::edge_method, "temperatures need \"images\": what stands beyond the edges has no temperature");
  if (of_bonds && d.surface_correction != SurfaceCorrection::position_aware)
    refuse(Subject::surface_correction,
           "temperatures need \"position_aware\", with which bonds bend freely without energy");
  for (std::size_t i = 0; i < problem.supports.size(); ++i)
    if (is_layer(problem.supports[i].kind))
      refuse(Subject::support_kind,
             "a layer outside the plate has no temperature: choose \"clamped\", \"simply_supported\" or "
             "\"simply_supported_hard\"",
             i);
  return found;
}

}  // namespace plate
