#pragma once
#include "plate/formulation/formulation.hpp"

namespace plate {

/// Families of cells (theory.md, "The Galerkin plate").
extern const FormulationKind galerkin;

}  // namespace plate
