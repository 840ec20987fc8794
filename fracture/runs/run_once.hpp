#pragma once
#include "fracture/runs/ready.hpp"
#include "fracture/runs/results.hpp"

namespace fracture {

class Keeper;

/// Runs a plate that is ready, at rest, in motion or for its frequencies, as the plan of the results says: whatever it
/// does goes to them as it comes, and the summary at last. Throws plate::NumericalError or plate::Interrupted after
/// that. `keeper`: of a motion that may go on later, or goes on here.
post::Summary run_once(const Ready& ready, Results& results, plate::Stopwatch& stopwatch, Keeper* keeper = nullptr);

}  // namespace fracture
