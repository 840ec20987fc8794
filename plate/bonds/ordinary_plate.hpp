#pragma once
#include "plate/model/numerical_method.hpp"

namespace plate {

/// Bonds over a horizon: the ordinary state-based plate (Dai et al. 2021).
extern const FormulationKind ordinary;

/// What "auto" stands for in a plate of so many points in which no parts may move: the diagonal or two levels.
Preconditioning usual_preconditioner_of_bonds(const Problem& problem, double points);

}  // namespace plate
