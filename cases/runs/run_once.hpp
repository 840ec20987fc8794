#pragma once
#include "cases/runs/results.hpp"
#include "cases/runs/run_plan.hpp"
#include "plate/solve/motion/dynamics.hpp"

namespace plate {
class Formulation;
}

namespace fracture {

class Keeper;
class MovingGrowth;
class Results;

/// Checkpoints of a motion by steps: saves its state and continues from it. All that is given must outlive it.
class KeptMotion {
public:
  KeptMotion(const plate::Formulation& plate, Results& results, MovingGrowth* growth)
      : plate_(plate), results_(results), growth_(growth) {}

  /// Makes the motion keep checkpoints, and go on from the one that was found.
  void keep_to(Keeper& keeper, plate::DynamicOptions& options);

private:
  void keep(Keeper& keeper, const plate::MotionMemory& now);
  /// Where processes share the plate: what all know apart from what each has of its points.
  void keep_part(Keeper& keeper, const plate::MotionMemory& now);
  bool recall(Keeper& keeper);
  void recall_part(const Keeper& keeper);
  bool remembers_earlier(std::size_t step) const;

  const plate::Formulation& plate_;
  Results& results_;
  MovingGrowth* growth_;
  plate::MotionMemory memory_;  // to go on from
};

class Keeper;

/// Runs a plate that is ready, at rest, in motion or for its frequencies, as the plan of the results says: whatever it
/// does goes to them as it comes, and the summary at last. Throws plate::NumericalError or plate::Interrupted after
/// that. `keeper`: of a motion that may go on later, or goes on here.
post::Summary run_once(const Ready& ready, Results& results, plate::Stopwatch& stopwatch, Keeper* keeper = nullptr);

}  // namespace fracture
