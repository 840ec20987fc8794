#pragma once
#include "plate/model/formulation_kind.hpp"

namespace plate {

/// Families of cells (theory.md, "The Galerkin plate").
extern const FormulationKind galerkin;

}  // namespace plate
