#include "plate/formulation/operator.hpp"

#include "plate/formulation/constraints.hpp"

namespace plate {

void Operator::internal_force_overlapped(const State& state, PendingExchange& rest, Forces& forces) const {
  rest.complete();
  internal_force(state, forces);
}

double half_work(const Operator& plate, const State& state) {
  Forces forces;
  plate.internal_force(state, forces);
  return -forces.cwiseProduct(state).sum() / 2;
}

}  // namespace plate
