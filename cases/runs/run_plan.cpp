#include "cases/runs/run_plan.hpp"

#include "cases/input/case_file.hpp"
#include "plate/solve/motion/time_grid.hpp"
#include "post/files/results_in_memory.hpp"

namespace cases {

RunOptions RunOptions::part(const std::string& name) const {
  if (in_memory) in_memory->parts[name].wants_fields = in_memory->wants_fields;
  return {folder / name, quiet, in_memory ? &in_memory->parts[name] : nullptr, resume, communicator};
}

bool RunPlan::reports() const {
  return !options.in_memory && content.output.reports();
}

plate::GridOptions grid_options(const Case& c) {
  // edges that a crack leaves at an angle to the lattice are a little stiffer than those of the start, families that
  // bonds leave one by one by 1.3 at most (measured where a plate fell to pieces)
  const double most = !c.growth ? 1.0 : c.growth->by_bonds() ? 0.8 : 0.9;
  return {c.analysis, c.output.history_every, most};
}

plate::Discretization widened(plate::Discretization points, double wider) {
  points.spacing *= wider, points.spacing_growth = std::min(1.0, points.spacing_growth * wider);
  if (points.tip_spacing) *points.tip_spacing *= wider;
  if (points.hole_spacing) *points.hole_spacing *= wider;
  return points;
}

}  // namespace cases
