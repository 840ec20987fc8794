#include "plate/solve/motion/initial_conditions.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"
#include "plate/model/supports.hpp"
#include "plate/model/wording.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/motion/contact_and_damping.hpp"
#include "plate/solve/motion/time_grid.hpp"
#include "plate/solve/prescribed_displacements.hpp"

namespace plate {
namespace {

using geometry::Point;

/// w with psi = grad w, by differences of the fourth order.
State bent(const Formulation& plate, const Formula& formula) {
  if (!formula.given()) return {};
  const double step = 1e-3 * plate.discretization().spacing_at_tips();
  const auto& positions = plate.cloud().positions;
  State result = zero_state(positions.size());
  for (std::size_t k = 0; k < plate.cloud().plate_points; ++k) {
    if (!plate.boundary().owns(k)) continue;
    const Point& x = positions[k];
    const auto slope = [&](const Point& along) {
      const auto at = [&](double n) { return formula(x + n * step * along); };
      return (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * step);
    };
    const PointValues u(formula(x), slope({0, 1}), -slope({1, 0}));  // psi = (-theta_y, theta_x)
    if (!u.allFinite()) throw FormulaError(formula, x);
    result.col(Eigen::Index(k)) = u;
  }
  plate.constraints().impose(result);
  return result;
}

/// Message about a deflection that is not nearly a straight line over a spacing about every point, or not zero where
/// supports hold an edge, as far as this rank sees; empty where the deflection is sound.
std::string error_in(const Formulation& plate, const Formula& formula, const State& state) {
  const auto points = Eigen::Index(plate.cloud().plate_points);
  const double spacing = plate.discretization().spacing_at_tips();
  const double size = largest_of(plate, state.row(0).head(points).cwiseAbs().maxCoeff());
  const double steepest = largest_of(plate, state.bottomRows(2).leftCols(points).colwise().norm().maxCoeff());
  for (Eigen::Index k = 0; k < points; ++k) {
    if (!plate.boundary().owns(std::size_t(k))) continue;
    for (const Point& along : {Point(spacing / 2, 0), Point(0, spacing / 2)}) {
      const Point& x = plate.cloud().positions[std::size_t(k)];
      const double change = std::abs(formula(x + along) - formula(x - along));
      if (change > 2 * spacing * steepest + 1e-9 * size)
        return fmt::format("jumps by {:g} about {}: a plate bends", change, text_of(x));
    }
  }
  const auto edges = geometry::straight_edges(plate.problem().outline);
  for (const auto& support : plate.problem().supports)
    for (const auto& edge : edges) {
      if (!held_by(support.kind).w || std::ranges::find(support.edges, edge.name) == support.edges.end()) continue;
      for (const double t : {0.05, 0.25, 0.5, 0.75, 0.95})
        if (const Point x = edge.from + t * (edge.to - edge.from); std::abs(formula(x)) > 0.02 * size)
          return fmt::format("is {:g} at {}, where a support holds the plate: let it be 0 there", formula(x),
                             text_of(x));
    }
  return "";
}

void require_possible(const Formulation& plate, const Formula& formula, const State& state) {
  for (const auto& error : texts_of_all(plate, error_in(plate, formula, state)))
    if (!error.empty()) throw Jumps(formula.text(), error);
}

/// True where this rank has points so near to the place that it presses on them, or on what follows them.
bool touches(const Formulation& plate, const Point& at) {
  constexpr double near = 8;  // spacings, of which a process sees many more
  const auto& cloud = plate.cloud();
  for (std::size_t k = 0; k < cloud.plate_points; ++k)
    if (plate.boundary().owns(k) && (cloud.positions[k] - at).norm() <= near * cloud.units.spacing) return true;
  return false;
}

Impactor impactor_of(const Impact& impact, const Formulation& plate) {
  Impactor result{{}, impact.mass, impact.velocity, impact.stiffness, &plate.boundary().map};
  const bool here = touches(plate, impact.position), anywhere = largest_of(plate, here) > 0;
  if (anywhere && !here) return result;
  result.terms = terms_of(plate.interpolation(impact.position), 0);
  return result;
}

double kinetic_energy(const Formulation& plate, const Forces& mass, const State& velocity) {
  return ordered_sum<1>(plate, std::size_t(mass.size()), [&](std::size_t i) {  // ghosts have no mass
    const double v = velocity.data()[i];
    return std::array<double, 1>{mass.data()[i] * v * v / 2};
  })[0];
}

}  // namespace

BeginOfMotion begin_of_motion(const Formulation& plate, double rotary) {
  const auto& problem = plate.problem();
  const auto initial = problem.initial.value_or(Initial{});
  BeginOfMotion result{bent(plate, initial.deflection), bent(plate, initial.velocity)};
  if (result.deflected.size() > 0) require_possible(plate, initial.deflection, result.deflected);
  if (result.deflected.size() > 0) result.given += plate.strain_energy(result.deflected);
  if (result.velocity.size() > 0) result.given += kinetic_energy(plate, plate.mass(rotary), result.velocity);
  if (const auto& impact = problem.impact) {
    result.impact = impactor_of(*impact, plate);
    result.given += impact->mass * impact->velocity * impact->velocity / 2;
  }
  return result;
}

double stable_step(double free, const Formulation& plate, const Analysis& analysis, const BeginOfMotion& begin) {
  if (begin.impact) free = stable_step(free, *begin.impact, plate.constraints(), plate.mass(analysis.rotary_inertia));
  return analysis.damping ? stable_step(free, *analysis.damping) : free;
}

DampedStep damped_step(double free, const Formulation& plate, const Analysis& analysis, const BeginOfMotion& begin) {
  const double exact = stable_step(free, plate, analysis, begin);
  if (!analysis.damping || has_prescribed_displacements(plate)) return {exact};
  if (analysis.time_step && *analysis.time_step <= exact) return {exact};
  Analysis undamped = analysis;
  undamped.damping.reset();
  return damped_step(stable_step(free, plate, undamped, begin), *analysis.damping, analysis.duration);
}

}  // namespace plate
