#include "cases/runs/run_plan.hpp"

namespace cases {

plate::GridOptions grid_options(const RunPlan& plan) {
  // edges that a crack leaves at an angle to the lattice are a little stiffer than those of the start, families that
  // bonds leave one by one by 1.3 at most (measured where a plate fell to pieces)
  const double most = !plan.growth ? 1.0 : plan.growth->by_bonds() ? 0.8 : 0.9;
  return {plan.analysis.duration, plan.analysis.time_step, plan.rows_every, plan.analysis.safety, most};
}

}  // namespace cases
