#include "cases/driver/foretell.hpp"

#include <cmath>
#include <ctime>

#include "cases/driver/results.hpp"
#include "cases/input/refused.hpp"
#include "plate/formulation/stopwatch.hpp"
#include "post/studies/scratch_folder.hpp"

namespace cases {
namespace {

using fracture::Less;

CaseFile sample_of(const CaseFile& file, const plate::UsualSolver& solver, const Less& less) {
  CaseFile result = file;
  Case& c = result.content;
  auto& d = c.discretization;
  d.spacing *= less.wider, d.spacing_growth = std::min(1.0, d.spacing_growth * less.wider);
  if (d.tip_spacing) *d.tip_spacing *= less.wider;
  if (d.hole_spacing) *d.hole_spacing *= less.wider;
  auto& analysis = c.analysis;
  if (analysis.kind == Analysis::Kind::static_) {
    analysis.preconditioner = solver.preconditioner;
    if (solver.method == plate::StaticMethod::direct) analysis.method = Analysis::Method::direct;
  }
  if (!less.solves && analysis.kind != Analysis::Kind::dynamic && !c.growth) analysis.tolerance = 0.1;
  analysis.time_step.reset();
  if (analysis.method == Analysis::Method::central_difference)
    analysis.duration = less.time_step > 0 ? less.steps * less.time_step : 1e-9 * analysis.duration;
  for (auto& load : c.loads) load.history = {};  // some start from nothing, and nothing would move
  c.output.history_every = analysis.duration / std::clamp(less.steps / 8, 1.0, 8.0);
  c.output.every.reset(), c.output.probes.clear();
  if (!less.factors) c.srif.reset();
  if (c.srif) c.srif->second_formulation = c.srif->richardson = false;
  if (c.growth) c.growth->max_advances = 1, c.growth->unstable = fracture::Growth::Unstable::jump;
  return result;
}

post::SampleRun run_of(const CaseFile& file, const plate::UsualSolver& solver, const Less& less) {
  const auto sample = sample_of(file, solver, less);
  const post::ScratchFolder scratch("pdplate_check");
  const auto begun = std::clock();
  plate::Stopwatch watch;
  post::SampleRun result{run(sample, {scratch.path(), true}), less.wider};
  watch.lap("run");
  result.share = std::min(1.0, double(std::clock() - begun) / CLOCKS_PER_SEC / watch.total());
  result.rings = less.factors ? fracture::rings_of(plan_of(file.content, {}), less.wider) : 0;
  const auto& analysis = sample.content.analysis;
  if (analysis.kind == Analysis::Kind::dynamic) {
    result.rows = 1 + std::round(analysis.duration / *sample.content.output.history_every);
    result.frames = 2;
  } else {
    result.frames = analysis.kind == Analysis::Kind::frequencies ? double(analysis.modes)
                    : sample.content.growth                      ? 2
                                                                 : 1;
  }
  result.files = scratch.bytes();
  return result;
}

}  // namespace

fracture::ForetoldRun foretell(const CaseFile& file) {
  const auto run = [&](const plate::UsualSolver& solver, const Less& less) -> std::optional<post::SampleRun> {
    try {
      return run_of(file, solver, less);
    } catch (const CaseError&) {
      if (less.wider == 1) throw;
      return {};
    }
  };
  return unless_refused(file, [&] { return fracture::foretell(plan_of(file.content, {}), run); });
}

}  // namespace cases
