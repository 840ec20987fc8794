#include "cases/driver/growth_run.hpp"

#include "cases/driver/discretised.hpp"
#include "cases/driver/results.hpp"
#include "fracture/runs/quasi_static_run.hpp"

namespace cases {
namespace {

/// The plate as it has grown quasi-statically, a hundredth above the load that is there, and what it does then.
CaseFile in_motion(CaseFile file, const fracture::QuasiStaticRun& run) {
  Case& c = file.content;
  c.analysis.kind = Analysis::Kind::dynamic;
  c.analysis.method = Analysis::Method::central_difference;
  c.analysis.start = Analysis::Start::equilibrium;
  c.analysis.duration = c.growth->duration;
  c.growth->unstable = fracture::Growth::Unstable::jump;
  c.output.every = c.growth->duration / 10;
  c.cracks = run.cracks();
  const double factor = 1.01 * run.load_factor();
  for (auto& load : c.loads) {
    load.value *= factor, load.twist *= factor;
    for (auto& component : load.tensor) component *= factor;
    load.history = {};
  }
  return file;
}

}  // namespace

post::Summary grow(const CaseFile& file, const RunOptions& options) {
  const Case& c = file.content;
  CaseFile with_factors = file;
  if (!c.growth->by_bonds()) with_factors.content.srif = fracture::factors_of_growth(c.srif);
  auto found = discretised(with_factors);
  check_growing_tips(file, *found.plate, found.warnings);
  tip_methods(with_factors, *found.plate);  // for what they refuse
  fracture::QuasiStaticRun run(plan_of(c, options), std::move(found));
  auto [recorder, keeper] = recording_of(c, options);
  auto summary = run(std::move(recorder), keeper.get());
  if (run.grown().ended.how == fracture::End::unstable && c.growth->unstable == fracture::Growth::Unstable::move)
    cases::run(in_motion(file, run), options.part("motion"));
  if (keeper) keeper->done();
  return summary;
}

}  // namespace cases
