#include "plate/formulation/operator.hpp"

#include "plate/formulation/constraints.hpp"
#include "plate/model/halo_exchange.hpp"
#include "tests/catch.hpp"

using namespace plate;

namespace {

/// Brings point 1 the deflection 5 at the end.
class Late : public HaloExchange {
public:
  void start(std::span<double> values) const override { values_ = values; }
  void start(std::span<float>) const override { FAIL("nobody asked for these"); }
  void finish() const override { values_[1] = 5; }

private:
  mutable std::span<double> values_;
};

class SpringOperator : public Operator {
public:
  std::size_t points() const override { return 2; }
  void internal_force(const State& state, Forces& forces) const override { forces = -2 * state; }
  void absolute_product(const State& state, Forces& forces) const override { forces = 2 * state; }
  Forces diagonal() const override { return Forces::Constant(3, 2, 2); }
};

}  // namespace

TEST_CASE("an operator that knows nothing of what a state waits for waits first") {
  Constraints constraints;
  constraints.resolve();
  constraints.share(single_process(), {1}, std::make_shared<Late>());
  State state = State::Ones(3, 2);
  Forces forces;
  PendingExchange rest(constraints, state);
  CHECK(state(0, 1) == 1);
  const SpringOperator spring;
  const Operator& op = spring;
  op.internal_force_overlapped(state, rest, forces);
  CHECK(state(0, 1) == 5);
  CHECK(forces(0, 1) == -10);
}
