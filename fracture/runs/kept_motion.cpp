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
#include "plate/solve/settled.hpp"

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
  std::vector<const plate::State*> states{&now.state, &now.velocity};
  if (remembers_earlier(now.step)) states.push_back(&now.earlier);
  states.push_back(&results_.state_of_largest());
  const auto own = own_values(plate_.boundary(), states);
  auto common = now;
  common.state = {}, common.velocity = {}, common.earlier = {};
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
  if (remembers_earlier(memory_.step)) states.push_back(&memory_.earlier);
  states.push_back(&largest);
  put_values(plate_.boundary(), keeper.parts(), states);
  (growth_ ? growth_->constraints() : plate_.constraints()).impose(memory_.state);
  if (largest.cols() == 0) return;
  plate_.constraints().impose(largest);
  if (const auto lift = plate::lift_at(plate_, results_.time_of_largest()); lift.cols() > 0) largest += lift;
}

/// The state of the step before: from the second one on, where the stiffness damps.
bool KeptMotion::remembers_earlier(std::size_t step) const {
  const auto& damping = results_.plan().analysis.damping;
  return step > 0 && damping && damping->stiffness > 0;
}

}  // namespace fracture
