#pragma once
#include "plate/model/formulation_kind.hpp"

namespace plate {

/// Bonds over a horizon: the ordinary state-based plate (Dai et al. 2021).
extern const FormulationKind ordinary;

}  // namespace plate
