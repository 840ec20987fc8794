#pragma once
#include "plate/solve/motion/dynamics.hpp"

namespace fracture {
class MovingGrowth;
}

namespace cases {

class Results;
class RunCheckpoints;

/// Checkpoints of a motion by steps: saves its state and continues from it. All that is given must outlive it.
class MotionCheckpoints {
public:
  MotionCheckpoints(const plate::Formulation& plate, Results& results, fracture::MovingGrowth* growth)
      : plate_(plate), results_(results), growth_(growth) {}

  /// Makes the motion keep checkpoints, and go on from the one that was found.
  void checkpoint_to(RunCheckpoints& checkpoints, plate::DynamicOptions& options);

private:
  void save(RunCheckpoints& checkpoints, const plate::MotionCheckpoint& now);
  bool restore(RunCheckpoints& checkpoints);

  const plate::Formulation& plate_;
  Results& results_;
  fracture::MovingGrowth* growth_;
  plate::MotionCheckpoint memory_;  // to go on from
};

}  // namespace cases
