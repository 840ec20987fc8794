#pragma once
#include <vector>

namespace plate {

struct Discretization;
struct FormulationKind;

/// Those that a problem may be solved with. What chooses by itself takes the first that can do what is asked for.
const std::vector<const FormulationKind*>& formulations();

/// The one of these that a plate may be solved with beside its own.
const FormulationKind& other_formulation(const FormulationKind& one);

/// The formulation of a discretisation: that of bonds is another one with surface nodes or
/// fictitious nodes.
const FormulationKind& formulation_of(const Discretization& discretization);

}  // namespace plate
