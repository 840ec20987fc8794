#include "cases/driver/foretell.hpp"

#include <ctime>

#include "cases/driver/run.hpp"
#include "cases/driver/second_formulation.hpp"
#include "cases/input/keys.hpp"
#include "geometry/cells/point_count.hpp"
#include "plate/formulation/stopwatch.hpp"
#include "plate/model/formulation_kind.hpp"
#include "plate/model/numerical_error.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/studies/scratch_folder.hpp"

namespace cases {
namespace {

// points of a larger sample: for factors; coarser plates begin above 4,000; threads hide the cost of a step below
constexpr double few = 1500, some = 4500, many = 16000;

/// How much wider the points of a sample are: near to `wanted`, and so that they divide the plate as its own do.
double wider_points(const Case& c, double wanted) {
  constexpr double least = 4;  // points across the plate
  const auto [low, high] = geometry::bounding_box(c.outline);
  const double across = (high - low).minCoeff() / c.discretization.spacing;
  return std::max(1.0, across / std::max(least, std::round(across / wanted)));
}

double expected_points(const Case& c) {
  const auto& d = c.discretization;
  return geometry::expected_points(c.outline, geometry::tips(plate::crack_paths(c)), d.spacing,
                                   {d.tip_spacing, d.hole_spacing, d.spacing_growth});
}

double rings_of(const Case& c, double wider) {
  return c.srif || c.growth ? post::widest_ring(c, wider) : 0;
}

/// How much less a sample does.
struct Less {
  double wider = 1;  // spacings
  bool factors = false;
  double steps = 1, time_step = 0;  // of a motion; 0: not known yet
  bool solves = false;              // to the tolerance of the case
};

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
  result.rings = less.factors ? rings_of(file.content, less.wider) : 0;
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

/// Two samples, the smaller one as often as its points are too wide.
std::optional<post::Samples> samples(const CaseFile& file, const plate::UsualSolver& solver, double all,
                                     double points) {
  const Case& c = file.content;
  const bool grows = c.growth.has_value() || !c.srif, steps = c.analysis.method == Analysis::Method::central_difference;
  const double wider = wider_points(c, std::sqrt(all / points));
  const auto less = [&](double by, bool factors) {
    return Less{by == 1 ? wider : wider_points(c, wider * by), factors && c.srif};
  };
  post::Samples result;
  try {
    for (const double by : {2.0, 1.4, 1.0}) try {
        const auto cold = run_of(file, solver, less(by, false));
        result.small = run_of(file, solver, less(by, false));
        result.opening = std::max(0.0, cold.seconds() - result.small.seconds());
        break;
      } catch (const CaseError&) {
        if (by == 1) throw;
      }
    auto whole = less(1, false);
    whole.solves = true;
    result.large = run_of(file, solver, whole);
    if (!grows) result.factors = run_of(file, solver, less(1, true));
    if (steps) {
      constexpr double enough = 64;
      result.longer =
          run_of(file, solver, {wider, c.srif.has_value(), enough, *result.large.summary.analysis.time_step_limit});
    }
  } catch (const CaseError&) {
    if (wider == 1) throw;
    return {};
  } catch (const plate::NumericalError&) {
    if (wider == 1) throw;
    return {};
  }
  return result;
}

/// Advances of a quasi-static growth until the cracks are as long as they may be, or have crossed the plate.
double advances_of(const Case& c) {
  const auto [low, high] = geometry::bounding_box(c.outline);
  double longest = 0;
  for (const auto& crack : c.cracks)
    for (std::size_t i = 1; i < crack.size(); ++i) longest = std::max(longest, (crack[i] - crack[i - 1]).norm());
  const double to = c.growth->max_length.value_or((high - low).maxCoeff());
  const double advances = std::max(1.0, (to - longest) / (c.growth->increment * c.discretization.spacing_at_tips()));
  return std::min(advances, double(c.growth->max_advances));
}

void set_motion(const CaseFile& file, ForetoldRun& result, const post::Samples& found) {
  const Case& c = file.content;
  auto& whole = result.whole;
  if (c.analysis.method == Analysis::Method::lanczos) {
    whole.rows = double(row_grid(file).steps);
  } else {
    result.time_limit = post::whole_time_step(found);
    const auto grid = time_grid(file, result.time_limit);
    result.time_step = grid.time_step, whole.steps = double(grid.steps);
    whole.rows = whole.steps / double(grid.steps_per_row);
  }
  whole.frames = 2 + (c.output.every ? std::floor(c.analysis.duration / *c.output.every) : 0);
}

}  // namespace

ForetoldRun foretell(const CaseFile& file) {
  const Case& c = file.content;
  const double all = expected_points(c);
  ForetoldRun result;
  using enum plate::Preconditioning;
  const bool modes = c.analysis.kind == Analysis::Kind::frequencies;
  const auto of_modes = c.discretization.formulation->offers(plate::Feature::levels) ? levels : diagonal;
  result.solver = plate::usual_solver(c, modes ? plate::StaticMethod::cg : c.analysis.static_method(),
                                      modes ? of_modes : c.analysis.preconditioner, all);
  const bool steps = c.analysis.method == Analysis::Method::central_difference;
  const bool moves = c.analysis.kind == Analysis::Kind::dynamic;
  const bool slow = !moves && (result.solver.method != plate::StaticMethod::cg || (modes && of_modes == diagonal));
  std::optional<post::Samples> found;
  const bool adr = slow && result.solver.method == plate::StaticMethod::adr;
  for (const double points : {adr ? few / 3 : slow ? few : steps ? many : some, slow ? some : many, 3 * many})
    if (!found) found = samples(file, result.solver, all, points);
  if (!found) found = samples(file, result.solver, all, all);

  auto& whole = result.whole;
  result.points = whole.points = post::whole_points(*found), result.bonds = post::whole_bonds(*found);
  result.sample_points = std::size_t(found->large.points());
  whole.rings = rings_of(c, 1);
  whole.frames = found->large.frames;
  if (!moves) whole.iterations_order = result.solver.iterations, whole.seconds_order = result.solver.seconds;
  if (moves) set_motion(file, result, *found);
  if (c.growth && c.analysis.kind == Analysis::Kind::static_)
    whole.advances = advances_of(c), whole.frames = 1 + whole.advances / double(c.growth->frames_every);
  result.costs = post::foretold(*found, whole);
  result.bytes = post::bytes_of_program(c.output.vtk || c.output.hdf5) + post::whole_parts(*found, result.points) +
                 (steps ? 0 : result.solver.bytes) +
                 (c.srif && !c.discretization.tip_spacing ? post::bytes_of_rings(whole.rings) : 0);
  return result;
}

}  // namespace cases
