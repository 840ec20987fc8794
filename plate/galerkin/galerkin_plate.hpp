#pragma once
#include "plate/model/formulation_kind.hpp"
#include "plate/model/solver_choices.hpp"

namespace plate {

/// Families of cells (theory.md, "The Galerkin plate").
extern const FormulationKind galerkin;

/// What "auto" stands for in a plate of so many points: coarser plates, or, as "automatic", its own factor.
Preconditioning usual_preconditioner_of_cells(const Problem& problem, double points);

}  // namespace plate
