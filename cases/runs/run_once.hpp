#pragma once
#include "cases/runs/results.hpp"
#include "cases/runs/run_plan.hpp"
#include "plate/solve/motion/dynamics.hpp"

namespace plate {
class Formulation;
}

namespace fracture {

class RunCheckpoints;
class MovingGrowth;
class Results;

/// Checkpoints of a motion by steps: saves its state and continues from it. All that is given must outlive it.
class MotionCheckpoints {
public:
  MotionCheckpoints(const plate::Formulation& plate, Results& results, MovingGrowth* growth)
      : plate_(plate), results_(results), growth_(growth) {}

  /// Makes the motion keep checkpoints, and go on from the one that was found.
  void checkpoint_to(RunCheckpoints& checkpoints, plate::DynamicOptions& options);

private:
  void save(RunCheckpoints& checkpoints, const plate::MotionCheckpoint& now);
  /// Saves a distributed plate: what all ranks know apart from what each has of its points.
  void save_part(RunCheckpoints& checkpoints, const plate::MotionCheckpoint& now);
  bool restore(RunCheckpoints& checkpoints);
  void restore_part(const RunCheckpoints& checkpoints);
  bool saves_earlier(std::size_t step) const;

  const plate::Formulation& plate_;
  Results& results_;
  MovingGrowth* growth_;
  plate::MotionCheckpoint memory_;  // to go on from
};

class RunCheckpoints;

/// Runs a plate that is ready, at rest, in motion or for its frequencies, as the plan of the results says: carry_out().
/// `checkpoints`: of a motion that may go on later, or goes on here.
post::Summary run_once(const ValidatedPlate& ready, Results& results, RunCheckpoints* checkpoints = nullptr);

}  // namespace fracture
