#include "plate/galerkin_witness.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/parts/held.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/numerical_error.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/refused.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/solution.hpp"

namespace plate {
namespace {

Problem of_galerkin(const Problem& bonds) {
  Problem result = bonds;
  result.discretization = {};
  result.discretization.spacing = bonds.discretization.spacing;
  result.discretization.formulation = &galerkin;
  const auto& holes = bonds.outline.holes;
  const auto round = [](const auto& hole) { return std::holds_alternative<geometry::Circle>(hole); };
  if (!holes.empty() && std::ranges::all_of(holes, round))
    result.discretization.hole_spacing = bonds.discretization.spacing / 2;
  return result;
}

bool near_force(const Problem& problem, const geometry::Point& x, double reach) {
  return std::ranges::any_of(problem.loads, [&](const Load& load) {
    return load.kind == Load::Kind::point_force && !load.moves() && (load.position - x).norm() < reach;
  });
}

struct Largest {
  double w = 0;
  geometry::Point at{0, 0};
};

/// |w| of the points that are as far from point forces.
Largest largest(const Formulation& plate, const State& state, double away) {
  const auto& cloud = plate.cloud();
  Largest result;
  for (std::size_t k = 0; k < cloud.plate_points; ++k)
    if (const double w = std::abs(state(0, Eigen::Index(k)));
        w > result.w && !near_force(plate.problem(), cloud.positions[k], away))
      result = {w, cloud.positions[k]};
  return result;
}

}  // namespace

std::optional<GalerkinWitness> galerkin_witness(const Problem& problem) {
  const StaticOptions options{1e-5, 20000, {}, {}};
  constexpr std::size_t many =
      4000;  // points; graded ones would take their factor, which is 2.5 times slower for 30,000
  try {
    auto made = discretise(of_galerkin(problem));
    if (!loose(*made.plate).empty()) return std::nullopt;
    Analysis analysis;
    if (made.plate->points() > many) analysis.preconditioner = Preconditioning::levels;
    auto found = static_solution(*made.plate, analysis, options);
    if (!found.solution.converged) return std::nullopt;
    return GalerkinWitness{std::move(made.plate), std::move(found.solution.state)};
  } catch (const Refused&) {  // a round hole that cells cannot follow, a support that they do not know
    return std::nullopt;
  } catch (const NumericalError&) {
    return std::nullopt;
  }
}

std::optional<DeflectionError> deflection_error(const Formulation& bonds, const State& state,
                                                const GalerkinWitness& witness) {
  const double spacing = bonds.discretization().spacing;
  const bool thick = bonds.section().thickness > spacing;  // then deflections grow without limit towards forces
  for (const double away : {thick ? 4 * spacing : 0, 0.0}) {
    const auto own = largest(bonds, state, away), right = largest(*witness.plate, witness.state, away);
    if (right.w > 0) return DeflectionError{own.w / right.w - 1, right.at};
  }
  return std::nullopt;
}

}  // namespace plate
