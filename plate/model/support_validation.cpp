#include "plate/model/support_validation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

#include "geometry/shape/crack_path.hpp"
#include "geometry/shape/patch.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/supports.hpp"
#include "plate/model/wording.hpp"

namespace plate {
namespace {

constexpr auto of_lines = " resists along edges and lines; a position has deflection and rotation";

/// Adds refusals of a spring as such, one sentence each.
void check_keys(const Spring& spring, std::size_t number, std::vector<Refusal>& found) {
  std::vector<std::string> errors;
  const bool ties = !spring.cracks.empty();
  const int places = !spring.edges.empty() + !spring.along.empty() + spring.position.has_value() + ties;
  if (places != 1)
    errors.push_back(
        fmt::format("{} given, must be one of edges, along, position and cracks", places == 0 ? "none" : "several"));
  const double stiffness = spring.deflection + spring.rotation_normal + spring.rotation_tangential + spring.rotation +
                           spring.opening + spring.sliding;
  if (spring.depth.given() && stiffness > 0)
    errors.push_back("depth gives the stiffnesses of a crack through a part of the thickness: remove the others");
  if (stiffness <= 0 && !spring.depth.given())
    errors.push_back(ties ? "resists nothing: give deflection, rotation_normal, rotation_tangential, opening or "
                            "sliding > 0, or depth"
                          : "resists nothing: give deflection, rotation_normal, rotation_tangential or rotation > 0");
  if (spring.from_below && !spring.depth.given()) errors.push_back("from is of a depth: remove it");
  if (!ties && spring.stretches()) errors.push_back("opening, sliding and depth are of springs on cracks");
  if (spring.position && spring.rotation_normal > 0) errors.push_back(fmt::format("rotation_normal{}", of_lines));
  if (spring.position && spring.rotation_tangential > 0)
    errors.push_back(fmt::format("rotation_tangential{}", of_lines));
  if (!spring.position && places > 0 && spring.rotation > 0)
    errors.push_back(
        "rotation is of a spring at a position; edges, lines and cracks have rotation_normal and rotation_tangential");
  if (!errors.empty()) found.push_back({Subject::spring, number, fmt::format("{}", fmt::join(errors, "; "))});
}

void check_edge(const Spring& spring, const std::string& edge, std::size_t number, const Problem& problem,
                std::vector<Refusal>& found) {
  for (std::size_t i = 0; i < problem.supports.size(); ++i) {
    const auto& support = problem.supports[i];
    if (std::ranges::find(support.edges, edge) == support.edges.end()) continue;
    const auto held = held_by(support.kind);
    std::vector<std::string> keys;
    if (held.w && spring.deflection > 0) keys.push_back("deflection");
    if (held.normal && spring.rotation_normal > 0) keys.push_back("rotation_normal");
    if (held.tangential && spring.rotation_tangential > 0) keys.push_back("rotation_tangential");
    if (!keys.empty())
      found.push_back({Subject::spring_edges, number,
                       fmt::format("edge \"{}\" is held by `support {}`, which leaves nothing for {} to do", edge, i,
                                   fmt::join(keys, " and "))});
  }
}

void check_stiffener(const Problem& problem, std::size_t number, std::vector<Refusal>& found) {
  const auto& beam = problem.stiffeners[number];
  std::vector<std::string> errors;
  const int places = !beam.edges.empty() + !beam.along.empty();
  if (places != 1)
    errors.push_back(fmt::format("{} given, must be one of edges and along", places == 0 ? "none" : "both"));
  if (beam.bending + beam.torsion + beam.axial <= 0)
    errors.push_back("stiffens nothing: give bending, torsion or axial > 0");
  if (beam.eccentricity != 0 && beam.axial <= 0)
    errors.push_back("eccentricity acts by the axial stiffness: give axial > 0");
  if (beam.shear && beam.bending <= 0) errors.push_back("shear is of a beam with bending > 0: remove it");
  if (!errors.empty()) found.push_back({Subject::stiffener, number, fmt::format("{}", fmt::join(errors, "; "))});
  for (std::size_t i = 0; i < problem.supports.size(); ++i)
    for (const auto& edge : beam.edges)
      if (const auto& s = problem.supports[i];
          held_by(s.kind).w && held_by(s.kind).normal && std::ranges::find(s.edges, edge) != s.edges.end())
        found.push_back(
            {Subject::stiffener_edges, number,
             fmt::format("edge \"{}\" is clamped by `support {}`, which leaves nothing for a beam to do", edge, i)});
}

/// Adds refusals of cracks through a part of the thickness that another spring ties too.
void check_depths(const Problem& problem, std::vector<Refusal>& found) {
  for (std::size_t i = 0; i < problem.springs.size(); ++i)
    for (std::size_t j = 0; j < problem.springs.size() && problem.springs[i].depth.given(); ++j)
      for (const auto crack : problem.springs[i].cracks)
        if (const auto& others = problem.springs[j].cracks;
            (j < i || !problem.springs[j].depth.given()) && std::ranges::find(others, crack) != others.end())
          found.push_back({Subject::spring_cracks, i,
                           fmt::format("crack {} has a depth, which is all that carries there: remove it from "
                                       "`spring {}`",
                                       crack, j)});
}

}  // namespace

std::vector<Refusal> errors_in_springs(const Problem& problem) {
  std::vector<Refusal> found;
  check_depths(problem, found);
  for (std::size_t i = 0; i < problem.stiffeners.size(); ++i) check_stiffener(problem, i, found);
  for (std::size_t i = 0; i < problem.springs.size(); ++i) {
    check_keys(problem.springs[i], i, found);
    for (const auto& edge : problem.springs[i].edges) check_edge(problem.springs[i], edge, i, problem, found);
  }
  const auto boundary = problem.discretization.boundary;
  if (problem.elastically_supported() &&
      (boundary == EdgeMethod::surface_nodes || boundary == EdgeMethod::fictitious_nodes))
    found.push_back({Subject::edge_method, 0,
                     "the stiffness of a plate with conditions at its edges has no place for foundations and springs: "
                     "choose \"images\""});
  return found;
}

namespace {

using geometry::Point;

bool clamps(SupportKind kind) {
  return kind == SupportKind::clamped || kind == SupportKind::clamped_layer;
}

/// Describes the part of its settlement that a support does not hold; empty where all is held.
std::string not_held(const Settlement& load, const Support& support) {
  if (support.holds_nothing()) return "holds nothing that could move";
  if (support.kind == SupportKind::symmetry && (load.value != 0 || !load.slope.isZero(0)))
    return "is a mirror plane, which holds no deflection: give a rotation alone";
  if (support.kind == SupportKind::hub && support.k_w) return "holds w by a spring, whose far end rests: remove k_w";
  if (support.kind == SupportKind::hub && support.k_phi && !load.slope.isZero(0))
    return "lets its hub turn: give no slope, or remove k_phi";
  if (support.kind == SupportKind::hub && load.rotation != 0)
    return "has no edges that could turn about themselves: give a slope";
  if (load.rotation != 0 && support.edges.empty()) return "has no edges that could turn about themselves: give a slope";
  if (load.rotation != 0 && !clamps(support.kind) && support.kind != SupportKind::symmetry)
    return "lets its edges turn about themselves: a rotation of them does nothing";
  return "";
}

/// A place where a support holds the plate, with the outward normal of an edge.
struct Place {
  Point x, normal{0, 0};
};

bool along(const geometry::Polyline& line, const Point& x, double tolerance) {
  return !line.empty() && geometry::distance(line, x) <= tolerance;
}

/// Places where the support holds the plate at x: on each of its edges there, or inside.
std::vector<Place> held_at(const Support& support, const geometry::Outline& outline, const Point& x) {
  const double tolerance = 1e3 * geometry::tolerance(outline);
  std::vector<Place> result;
  for (const auto& edge : geometry::straight_edges(outline))
    if (std::ranges::find(support.edges, edge.name) != support.edges.end() &&
        along({edge.from, edge.to}, x, tolerance)) {
      const Point way = (edge.to - edge.from).normalized();
      result.push_back({x, {way.y(), -way.x()}});
    }
  for (const auto& hole : outline.holes)
    if (const auto* circle = std::get_if<geometry::Circle>(&hole);
        circle && std::ranges::find(support.edges, circle->name) != support.edges.end() &&
        std::abs((x - circle->centre).norm() - circle->radius) <= tolerance)
      result.push_back({x, (circle->centre - x).normalized()});
  bool inside = along(support.along, x, tolerance);
  for (const auto& point : support.points) inside = inside || (point - x).norm() <= tolerance;
  if (auto ring = support.patch ? geometry::Patch(*support.patch).ring() : std::vector<Point>(); !ring.empty()) {
    const geometry::Outline part{{ring, std::vector<std::string>(ring.size())}, {}};
    ring.push_back(ring.front());
    inside = inside || geometry::contains(part, x) || along(ring, x, tolerance);
  }
  if (inside) result.push_back({x});
  return result;
}

/// Ends and corners of all that a support holds.
std::vector<Point> ends_of(const Support& support, const geometry::Outline& outline) {
  std::vector<Point> result = support.points;
  result.insert(result.end(), support.along.begin(), support.along.end());
  for (const auto& edge : geometry::straight_edges(outline))
    if (std::ranges::find(support.edges, edge.name) != support.edges.end())
      result.push_back(edge.from), result.push_back(edge.to);
  if (support.patch)
    for (const auto& x : geometry::Patch(*support.patch).ring()) result.push_back(x);
  return result;
}

/// Lines within the plate that a support holds, and the boundary of the part that it holds.
std::vector<geometry::Polyline> lines_of(const Support& support) {
  std::vector<geometry::Polyline> result;
  if (!support.along.empty()) result.push_back(support.along);
  if (support.patch) {
    auto ring = geometry::Patch(*support.patch).ring();
    if (ring.empty()) return result;  // of a shape that is refused elsewhere
    ring.push_back(ring.front());
    result.push_back(std::move(ring));
  }
  return result;
}

/// Points where lines of two supports cross.
std::vector<Point> crossings(const Support& one, const Support& other) {
  std::vector<Point> result;
  for (const auto& first : lines_of(one))
    for (const auto& second : lines_of(other))
      for (std::size_t i = 0; i + 1 < first.size(); ++i)
        for (std::size_t j = 0; j + 1 < second.size(); ++j) {
          const Point a = first[i], d = first[i + 1] - a, b = second[j], e = second[j + 1] - b;
          const double sine = d.x() * e.y() - d.y() * e.x();
          if (sine == 0 || !geometry::meet(a, a + d, b, b + e)) continue;
          result.emplace_back(a + ((b - a).x() * e.y() - (b - a).y() * e.x()) / sine * d);
        }
  return result;
}

/// Values that a support prescribes at a place: w and, as far as it holds them, the slopes.
struct Kept {
  std::optional<double> w;
  std::vector<std::pair<Point, double>> slopes;  // d . psi, d of unit length
};

/// Settlements that act together at all times.
using Together = std::vector<SupportMotion>;

Kept kept(const Problem& problem, std::size_t number, const Place& at, const Together& motions) {
  using enum SupportKind;
  const auto& support = problem.supports[number];
  Kept result;
  PointValues body(0, 0, 0);
  for (const auto& motion : motions)
    if (motion.settlement.support == number) body += motion.at(at.x, at.normal, 0);
  const Point psi(-body[2], body[1]);
  const auto add = [&](const Point& d) { result.slopes.emplace_back(d, d.dot(psi)); };
  const bool hard = support.kind == simply_supported_hard || support.kind == simply_supported_hard_layer;
  if (support.kind != symmetry && !support.holds_nothing()) result.w = body[0];
  const bool rigid = support.kind == hub && !support.k_phi;
  if (clamps(support.kind) || rigid) add({1, 0}), add({0, 1});
  if (hard) add({-at.normal.y(), at.normal.x()});
  if (support.kind == symmetry) add(at.normal);
  return result;
}

/// True where both hold the same of the place, at different values.
bool apart(const Kept& one, const Kept& other, double deflection, double slope) {
  constexpr double rounding = 1e-9, parallel = 1 - 1e-9;
  if (one.w && other.w && std::abs(*one.w - *other.w) > rounding * deflection) return true;
  for (const auto& [d, value] : one.slopes)
    for (const auto& [e, wanted] : other.slopes) {
      const double along = d.dot(e);
      if (std::abs(along) > parallel && std::abs(value - (along > 0 ? wanted : -wanted)) > rounding * slope)
        return true;
    }
  return false;
}

/// A place that two supports, or two edges of one, hold apart under settlements; empty where there is none.
std::string torn(const Problem& problem, const Together& motions) {
  const auto [low, high] = geometry::bounding_box(problem.outline);
  double slope = 0, deflection = 0;  // at most, anywhere
  for (const auto& [load, one] : motions) {
    const double reach = std::max((one.from - low).norm(), (one.from - high).norm()) + (high - low).norm();
    slope += one.slope.norm() + std::abs(one.rotation);
    deflection += std::abs(one.value) + one.slope.norm() * reach;
  }
  const auto moves = [&](std::size_t i) {
    return std::ranges::any_of(motions, [i](const auto& motion) { return motion.settlement.support == i; });
  };
  const auto& supports = problem.supports;
  for (std::size_t i = 0; i < supports.size(); ++i)
    for (std::size_t j = i; j < supports.size(); ++j) {
      if (!moves(i) && !moves(j)) continue;
      auto places = ends_of(supports[i], problem.outline);
      for (const auto& x : ends_of(supports[j], problem.outline)) places.push_back(x);
      for (const auto& x : crossings(supports[i], supports[j])) places.push_back(x);
      for (const auto& x : places)
        for (const auto& here : held_at(supports[i], problem.outline, x))
          for (const auto& there : held_at(supports[j], problem.outline, x))
            if (apart(kept(problem, i, here, motions), kept(problem, j, there, motions), deflection, slope))
              return fmt::format("`support {}` and {} hold the plate at {}, which would be torn there", i,
                                 j == i ? "another edge of it" : fmt::format("`support {}`", j), text_of(x));
    }
  return "";
}

/// Groups the settlements of one load case, or of none, with one history.
std::vector<Together> together(const Problem& problem) {
  const auto case_of = [&](std::size_t load) {
    std::size_t count = shared_loads(problem), which = 0;
    while (load >= count) count += problem.load_cases[which++].loads.size();
    return which;
  };
  std::vector<Together> result;
  for (const auto& motion : support_motions(problem)) {
    const auto with = [&](const Together& known) {
      const auto other = known.front().load;
      return case_of(other) == case_of(motion.load) &&
             problem.loads[other].history == problem.loads[motion.load].history;
    };
    const auto found = std::ranges::find_if(result, with);
    found == result.end() ? result.push_back({motion}) : found->push_back(motion);
  }
  return result;
}

}  // namespace

std::vector<std::string> warnings_about_held_holes(const Problem& problem) {
  constexpr double near = 0.1;       // of the radius, from a rim to pins on it
  constexpr std::size_t fixing = 2;  // pins that stand for a fixing
  std::vector<std::string> level, pinned, result;
  for (const auto& circle : geometry::circles(problem.outline)) {
    std::size_t pins = 0;
    for (const auto& support : problem.supports) {
      if ((support.kind == SupportKind::simply_supported || support.kind == SupportKind::simply_supported_hard) &&
          std::ranges::find(support.edges, circle.name) != support.edges.end())
        level.push_back(circle.name);
      if (support.kind == SupportKind::pinned)
        pins += std::size_t(std::ranges::count_if(support.points, [&](const geometry::Point& x) {
          return std::abs((x - circle.centre).norm() - circle.radius) <= near * circle.radius;
        }));
    }
    if (pins >= fixing) pinned.push_back(circle.name);
  }
  const auto say = [&](const std::vector<std::string>& names, const std::string& what) {
    if (names.empty()) return;
    const auto more = names.size() > 1 ? fmt::format(" and {} more", names.size() - 1) : std::string();
    result.push_back(
        fmt::format("{}{}: {}; for fixings that turn set kind = \"hub\" and k_phi = 0", names.front(), more, what));
  };
  say(level, "simply_supported all round hinders the rim's turn");
  say(pinned, "pins on the rim hold the plate too softly");
  return result;
}

std::vector<std::string> warnings_about_hubs(const Problem& problem) {
  const double spacing = problem.discretization.spacing;
  std::vector<geometry::Circle> discs;
  for (const auto& support : problem.supports)
    if (support.kind == SupportKind::hub && support.patch) discs.push_back(std::get<geometry::Circle>(*support.patch));
  std::vector<std::string> result;
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const auto& [centre, radius, name] = discs[i];
    double least = INFINITY;
    const auto look = [&, radius = radius](double gap) {
      if (gap - radius > 0) least = std::min(least, gap - radius);
    };
    look(geometry::distance_to_boundary(problem.outline, centre));
    for (const auto& crack : problem.cracks) look(geometry::distance(crack, centre));
    for (std::size_t j = 0; j < discs.size(); ++j)
      if (j != i) look((discs[j].centre - centre).norm() - discs[j].radius);
    if (least < spacing * (1 - 1e-9))
      result.push_back(
          fmt::format("hub{}: an edge, a crack or another disc is {:.2g} spacings from its rim: errors may "
                      "exceed their estimates; set `spacing` = {:.2g}",
                      i, least / spacing, least));
  }
  return result;
}

std::vector<Refusal> errors_in_settlements(const Problem& problem) {
  std::vector<Refusal> found;
  for (std::size_t i = 0; i < problem.loads.size(); ++i) {
    const auto* settlement = problem.loads[i].as<Settlement>();
    if (!settlement) continue;
    const auto& load = *settlement;
    const auto say = [&](const std::string& what) { found.push_back({Subject::settlement, i, what}); };
    if (load.support >= problem.supports.size()) {
      say(fmt::format("{} given, there {}", load.support,
                      problem.supports.empty() ? "is no `support`"
                                               : fmt::format("are the supports 0 to {}", problem.supports.size() - 1)));
      continue;
    }
    if (const auto what = not_held(load, problem.supports[load.support]); !what.empty())
      say(fmt::format("`support {}` {}", load.support, what));
    const auto method = problem.discretization.boundary;
    if (method == EdgeMethod::surface_nodes || method == EdgeMethod::fictitious_nodes)
      found.push_back({Subject::edge_method, 0,
                       "conditions at nodes on edges are for supports that rest: choose \"images\", or remove the "
                       "settlement"});
  }
  if (!found.empty()) return found;
  for (const auto& motions : together(problem))
    if (const auto what = torn(problem, motions); !what.empty())
      found.push_back({Subject::settlement, motions.front().load, what});
  return found;
}

}  // namespace plate
