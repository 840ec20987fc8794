#include "cases/runs/motion_checkpoints.hpp"

#include "cases/runs/checkpoints.hpp"
#include "cases/runs/results.hpp"
#include "fracture/growth/moving_growth.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/reduction.hpp"
#include "plate/solve/archive.hpp"
#include "plate/solve/prescribed_displacements.hpp"

namespace cases {

void MotionCheckpoints::checkpoint_to(RunCheckpoints& checkpoints, plate::DynamicOptions& options) {
  options.due = [&] { return plate::largest_of(plate_, checkpoints.due()) > 0; };
  options.save = [&](const plate::MotionCheckpoint& now) { save(checkpoints, now); };
  if (restore(checkpoints)) options.from = &memory_;
}

void MotionCheckpoints::save(RunCheckpoints& checkpoints, const plate::MotionCheckpoint& now) {
  const auto save_state = [&](plate::OutArchive& archive) {
    archive(now, now.earlier.cols() > 0);
    results_.save(archive);
    if (growth_) growth_->save(archive);
  };
  checkpoints.save(save_state, [&] {
    return own_values(plate_.boundary(), {&now.state, &now.velocity, &now.earlier, &results_.state_of_largest()});
  });
}

bool MotionCheckpoints::restore(RunCheckpoints& checkpoints) {
  bool has_earlier = false;
  const bool found = checkpoints.restore([&](plate::InArchive& archive) {
    archive(memory_, has_earlier);
    results_.restore(archive);
    if (growth_) growth_->restore(archive);
  });
  if (!found) return false;
  const auto impose = [&](plate::State& state) {
    (growth_ ? growth_->constraints() : plate_.constraints()).impose(state);
  };
  const auto impose_and_lift = [&](plate::State& state) {
    plate_.constraints().impose(state);
    if (const auto lift = plate::lift_at(plate_, results_.time_of_largest()); lift.cols() > 0) state += lift;
  };
  std::vector<RestoredState> states{{&memory_.state, impose}, {&memory_.velocity}};
  if (has_earlier) states.push_back({&memory_.earlier});
  states.push_back({&results_.state_of_largest(), impose_and_lift});
  put_values(plate_.boundary(), checkpoints.parts(), states);
  return true;
}

}  // namespace cases
