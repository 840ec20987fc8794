#pragma once
#include "plate/model/numerical_method.hpp"

namespace plate {

/// Bonds over a horizon: the ordinary state-based plate (Dai et al. 2021).
extern const FormulationKind ordinary;

/// Preconditioner that "auto" selects for a plate with this number of points in which no parts may move: diagonal or
/// two-level.
Preconditioning usual_preconditioner_of_bonds(const Problem& problem, double points);

}  // namespace plate
