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
  remembers_force_ = options.stiffness_damping > 0;
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
  std::vector<const plate::State*> states{&now.state, &now.velocity};
  if (remembers_force_) states.push_back(&now.force);
  states.push_back(&results_.state_of_largest());
  const auto own = own_values(plate_.boundary(), states);
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
  std::vector<plate::State*> states{&memory_.state, &memory_.velocity};
  if (remembers_force_) states.push_back(&memory_.force);
  states.push_back(&largest);
  put_values(plate_.boundary(), keeper.parts(), states);
  (growth_ ? growth_->constraints() : plate_.constraints()).impose(memory_.state);
  if (largest.cols() > 0) plate_.constraints().impose(largest);
}

}  // namespace fracture
