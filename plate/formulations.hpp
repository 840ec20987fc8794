#pragma once
#include <string>
#include <vector>

#include "plate/model/numerical_method.hpp"

namespace plate {

struct Problem;

/// Formulations that a problem may be solved with. An automatic choice takes the first that can do what is asked for.
const std::vector<const FormulationKind*>& formulations();

/// The one of these that a plate may be solved with beside its own.
const FormulationKind& other_formulation(const FormulationKind& one);

/// The formulation of a discretisation: that of bonds is another one with surface nodes or
/// fictitious nodes.
const FormulationKind& formulation_of(const Discretization& discretization);

/// The way to the equilibrium of a plate of so many points, told without the plate, and how its cost follows their
/// number.
struct UsualSolver {
  StaticMethod method;  // direct where the plate of these points is solved by its own factor
  Preconditioning preconditioner;
  std::string words;      // "conjugate gradients, two levels"
  double iterations = 0;  // the order of their number in the number of points
  double seconds = 1;     // the same of the time of all of them
  double bytes = 0;       // at its peak, beside the plate and the vectors
};

/// Estimates the solver and the cost of a static solution with these settings; "automatic" is resolved as for a plate
/// whose parts cannot move. Orders and bytes were measured on square plates with a crack (tests/benchmarks, "What check
/// foretells").
UsualSolver usual_solver(const Problem& problem, StaticMethod method, Preconditioning wanted, double points);

}  // namespace plate
