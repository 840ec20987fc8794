#include "plate/solve/solution.hpp"

#include "plate/formulation/formulation.hpp"
#include "plate/formulation/preconditioner.hpp"

namespace plate {

StaticResult solve_static(const Formulation& plate, const Forces& load, StaticMethod method, Preconditioning wanted,
                          const StaticOptions& options) {
  const auto& constraints = plate.constraints();
  if (method == StaticMethod::adr)
    return {adaptive_dynamic_relaxation(plate, constraints, load, options), "adr", {}, 0};
  if (method == StaticMethod::direct) {
    const auto factor = plate.factor();
    return {conjugate_gradients(plate, constraints, load, options, factor.get()), "direct", {}, factor->bytes()};
  }
  const auto [inverse, name] = plate.preconditioner(wanted);
  return {conjugate_gradients(plate, constraints, load, options, inverse.get()), "cg", name,
          inverse ? inverse->bytes() : 0};
}

std::unique_ptr<Preconditioner> inverse_of(const Formulation& plate) {
  constexpr std::size_t many = 100000;  // points
  if (plate.points() <= many || !plate.offers(Feature::levels)) return plate.factor();
  return plate.preconditioner(Preconditioning::levels).inverse;
}

}  // namespace plate
