#include "plate/formulations.hpp"

#include "plate/bonds/ordinary_plate.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/refused.hpp"
#include "plate/surface/surface_formulation.hpp"

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

Discretised discretise(const Problem& problem) {
  require_memory(problem);
  Problem settled = problem;
  settled.discretization.formulation = &formulation_of(problem.discretization);
  settled.supports = settled_supports(problem);
  try {
    return settled.discretization.formulation->discretise(settled);
  } catch (const FormulaError& error) {
    std::size_t number = 0;
    while (problem.loads[number].formula.text() != error.formula()) ++number;
    throw Refused({{Subject::load_expression, number, error.what()}});
  }
}

}  // namespace plate
