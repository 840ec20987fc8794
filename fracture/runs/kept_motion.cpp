#include "fracture/runs/kept_motion.hpp"

#include "fracture/growth/motion/moving_growth.hpp"
#include "fracture/runs/keeper.hpp"
#include "fracture/runs/results.hpp"
#include "fracture/runs/shared/among_ranks.hpp"
#include "fracture/runs/shared/own_values.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/solve/archive.hpp"
#include "plate/solve/reduction.hpp"

namespace fracture {
void KeptMotion::keep_to(Keeper& keeper, plate::DynamicOptions& options) {
  options.due = [&] { return plate::largest_of_all(keeper.due()) > 0; };
  options.keep = [&](const plate::MotionMemory& now) { shared() ? keep_part(keeper, now) : keep(keeper, now); };
  if (recall(keeper)) options.from = &memory_;
}

void KeptMotion::keep(Keeper& keeper, const plate::MotionMemory& now) {
  keeper.keep([&](plate::OutArchive& archive) {
    archive(now);
    results_.remember(archive);
    if (growth_) growth_->remember(archive);
  });
}

void KeptMotion::keep_part(Keeper& keeper, const plate::MotionMemory& now) {
  const auto own = own_values(plate_.boundary(), {&now.state, &now.velocity, &results_.state_of_largest()});
  plate::MotionMemory common{now.step, {}, {}, now.loads, now.work, now.before};
  common.given = now.given, common.dissipated = now.dissipated;
  keeper.keep(
      [&](plate::OutArchive& archive) {
        archive(common);
        results_.remember(archive);
        if (growth_) growth_->remember(archive);
      },
      &own);
}

bool KeptMotion::recall(Keeper& keeper) {
  const bool found = keeper.recall([&](plate::InArchive& archive) {
    archive(memory_);
    results_.recall(archive);
    if (growth_) growth_->recall(archive);
  });
  if (found && shared()) recall_part(keeper);
  return found;
}

void KeptMotion::recall_part(const Keeper& keeper) {
  auto& largest = results_.state_of_largest();
  put_values(plate_.boundary(), keeper.parts(), {&memory_.state, &memory_.velocity, &largest});
  (growth_ ? growth_->constraints() : plate_.constraints()).impose(memory_.state);
  if (largest.cols() > 0) plate_.constraints().impose(largest);
}

}  // namespace fracture
