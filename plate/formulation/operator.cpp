#include "plate/formulation/operator.hpp"

#include "plate/formulation/constraints.hpp"

namespace plate {

void Operator::internal_force_meanwhile(const State& state, Awaited& rest, Forces& forces) const {
  rest.complete();
  internal_force(state, forces);
}

}  // namespace plate
