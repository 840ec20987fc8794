#include "plate/formulations.hpp"

#include <cmath>

#include "plate/bonds/ordinary_plate.hpp"
#include "plate/edges/surface_formulation.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/membrane.hpp"
#include "plate/model/problem.hpp"

namespace plate {

const std::vector<const FormulationKind*>& formulations() {
  static const std::vector<const FormulationKind*> known{&galerkin, &ordinary};
  return known;
}

const FormulationKind& other_formulation(const FormulationKind& one) {
  const auto& known = formulations();
  return one.name == known.front()->name ? *known.back() : *known.front();
}

const FormulationKind& formulation_of(const Discretization& d) {
  if (d.formulation != &ordinary) return *d.formulation;
  if (d.boundary == EdgeMethod::fictitious_nodes) return bonds_with_fictitious_nodes;
  return d.boundary == EdgeMethod::surface_nodes ? bonds_with_surface_nodes : *d.formulation;
}

Discretised discretise(const Problem& problem, const Communicator& communicator) {
  require_memory(problem);
  Problem resolved = problem;
  resolved.discretization.formulation = &formulation_of(problem.discretization);
  resolved.supports = resolved_supports(problem);
  try {
    return resolved.discretization.formulation->discretise(resolved, communicator);
  } catch (const FormulaError& error) {
    for (std::size_t i = 0;; ++i) {
      const auto& load = problem.loads[i];
      if (load.formula().text() == error.formula()) throw Refused({{Subject::load_expression, i, error.what()}});
      if (const auto* heat = load.as<Temperature>(); heat && heat->mean_formula.text() == error.formula())
        throw Refused({{Subject::load_mean, i, error.what()}});
    }
  }
}

namespace {

constexpr double of_diagonal = 0.5;  // iterations follow the side over the spacing
// of time: a factor of the whole from 2,500 to 40,000 points, one of a quarter of them, coarser plates
constexpr double of_factor = 1.4, of_general_factor = 1.55, of_short_horizon = 1.25, of_two_levels = 1.08,
                 of_multigrid = 1.05;

/// Bytes while a factor is made, measured 3,770 to 4,220 n log2 n with bonds over 3 spacings (10,000 and 40,000
/// points), 9,200 to 11,200 with nodes on or beyond the edges, whose matrix is not symmetric (2,500 to 40,000 points;
/// what UMFPACK keeps in the end is 4,000 of them), 780 to 920 of cells (10,000 to 47,000), 300 with a short horizon
/// (40,000), 1,225 and 1,308 n for two levels (40,000 and 160,000); of cells with their plane 2,600 (see
/// check_memory()), of which 1,200 to 1,500 stay (1,000 to 3,700).
double bytes_of_factor(double per_point, double points) {
  return per_point * points * std::log2(points + 2);
}

/// The factor of the last level, of up to 4,000 points, and the others: measured 29 to 84 MB for 10,000 to 161,000
/// points of a lattice, 35 and 58 MB for 12,000 and 47,000 of triangles.
double bytes_of_multigrid(const Discretization& d, double points) {
  return 25e6 + (d.tip_spacing || d.hole_spacing ? 700 : 350) * points;
}

}  // namespace

UsualSolver usual_solver(const Problem& problem, StaticMethod method, Preconditioning wanted, double points) {
  using enum Preconditioning;
  if (method == StaticMethod::adr)
    return {method, automatic, "adaptive dynamic relaxation", of_diagonal, 1 + of_diagonal};
  const auto& d = problem.discretization;
  const bool bonds = d.formulation == &ordinary;
  const bool general = bonds && (d.boundary == EdgeMethod::surface_nodes || d.boundary == EdgeMethod::fictitious_nodes);
  const double of_bonds = (general ? 1120 : 440) * d.horizon_ratio * d.horizon_ratio;
  if (rests_with_plane(problem))
    return {StaticMethod::direct,         automatic, "factor of the plate and its plane", 0, of_factor,
            bytes_of_factor(2600, points)};
  const UsualSolver own_factor{StaticMethod::direct,
                               automatic,
                               "factor of the plate",
                               0,
                               general ? of_general_factor : of_factor,
                               bytes_of_factor(bonds ? of_bonds : 850, points)};
  if (method == StaticMethod::direct || general) return own_factor;
  if (wanted == automatic)
    wanted = bonds ? usual_preconditioner_of_bonds(problem, points) : usual_preconditioner_of_cells(problem, points);
  switch (wanted) {
    case automatic:
      return own_factor;
    case diagonal:
      return {method, wanted, "conjugate gradients", of_diagonal, 1 + of_diagonal};
    case local:
      return {method, wanted, "conjugate gradients, local plate", 0, of_short_horizon, bytes_of_factor(300, points)};
    case two_level:
      return {method, wanted, "conjugate gradients, two levels", 0, of_two_levels, bytes_of_factor(88 * 4, points / 4)};
    case levels:
      return {method, wanted, "conjugate gradients, coarser plates", 0, of_multigrid, bytes_of_multigrid(d, points)};
  }
  return own_factor;
}

}  // namespace plate
