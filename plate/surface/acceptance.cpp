#include "plate/surface/acceptance.hpp"

#include <fmt/format.h>
#include <algorithm>
#include "plate/model/refused.hpp"
#include "plate/surface/oblique/clearance.hpp"

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

/// What lies beyond an edge is expanded from points behind it, as far as a horizon, and must not be seen from behind
/// another edge; edges as short as a horizon have too few nodes of their own.
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
                    "each other, or points see what lies behind both",
                    c.gap.value, place_text(c.gap.at), words(method), 2 * horizon) +
            images + ", or a smaller spacing");
  if (c.step.value < least)
    refuse_plate(Subject::geometry,
                 fmt::format("an edge is {:.3g} long at {}: {} need a horizon, {:.3g}, between two corners",
                             c.step.value, place_text(c.step.at), words(method), horizon) +
                     images + ", or a smaller spacing");
}

/// What is known on oblique edges is of the local plate and of whole cells: deflections under loads on them did not
/// converge, and rotations held alone there leave moments of reactions a third off.
void check_oblique(const Problem& problem) {
  if (is_rectilinear(problem.outline)) return;
  const std::string instead =
      " is refused with surface nodes where the plate has edges oblique to the lattice, as its error does not fall "
      "with "
      "the spacing: choose boundary = \"images\" or formulation = \"galerkin\"";
  for (std::size_t k = 0; k < problem.supports.size(); ++k)
    if (problem.supports[k].kind == SupportKind::symmetry) throw Refused({{Subject::support, k, "symmetry" + instead}});
  for (std::size_t k = 0; k < problem.loads.size(); ++k)
    if (!problem.loads[k].edges.empty()) throw Refused({{Subject::load_edges, k, "a load on an edge" + instead}});
}

/// What lies beyond an edge is expanded from points that must see each other.
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

/// How wide a horizon may be, over the thickness and over the narrowest part of the plate.
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
      if (std::ranges::find(one.edges, edge) != one.edges.end()) return one.kind;
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
  const auto [of_thickness, of_side] = widest(problem, method);
  const double thickness = problem.section.thickness, side = clearance_of(problem).width.value;
  const double horizon = problem.discretization.horizon(),
               most = std::min(of_thickness * thickness, of_side * side) * (1 + 1e-9);
  if (horizon <= most) return;
  refuse_plate(
      Subject::spacing,
      fmt::format(
          "the horizon is {:.3g} times the thickness and {:.2g} of the shorter side, or of the narrowest part "
          "of the plate: with {} on edges like these {:g} and {:g} at most (more where all edges are clamped or "
          "hard supported), spacing {:.3g}; or choose boundary = \"images\"",
          horizon / thickness, horizon / side, words(method), of_thickness, of_side,
          problem.discretization.spacing * most / horizon));
}

}  // namespace

void check(const Problem& problem, const std::vector<geometry::CrackPath>& paths, EdgeMethod method) {
  check_outline(problem, method);
  if (method == EdgeMethod::surface_nodes) check_oblique(problem);
  check_cracks(problem, paths, method);
  check_horizon(problem, method);
}

}  // namespace plate
