#include "plate/formulation/operator.hpp"

#include "plate/formulation/constraints.hpp"

namespace plate {

void Operator::internal_force_overlapped(const State& state, PendingExchange& rest, Forces& forces) const {
  rest.complete();
  internal_force(state, forces);
}

}  // namespace plate
