#include "cases/runs/cost_estimate.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "cases/input/case_file.hpp"
#include "cases/runs/run_plan.hpp"
#include "geometry/cells/tessellation.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/bonds/part_of_lattice.hpp"
#include "plate/galerkin/discretised_cells.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/numerical_method.hpp"
#include "plate/solve/motion/time_grid.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/report/conclusion.hpp"

namespace cases {
namespace {

using plate::Analysis;

// points of a larger sample: for factors; coarser plates begin above 4,000; threads hide the cost of a step below
constexpr double few = 1500, some = 4500, many = 16000;

// steps of the longer sample of a motion: more until they take long enough to be timed [processor s]
constexpr double least_steps = 64, most_steps = 1 << 18, long_enough = 0.1;
constexpr double frames_of_period = 8;      // of a harmonic response
constexpr std::size_t few_frequencies = 8;  // of its samples

/// True of motions in time and of the harmonic response.
bool is_motion(const Analysis& analysis) {
  return analysis.kind == Analysis::Kind::dynamic || analysis.kind == Analysis::Kind::harmonic;
}

/// Factor by which the spacing of a sample is larger: near to `wanted`, and such that its points divide the plate as
/// those of the problem do.
double wider_points(const plate::Problem& problem, double wanted) {
  constexpr double least = 4;  // points across the plate
  const auto [low, high] = geometry::bounding_box(problem.outline);
  const double across = (high - low).minCoeff() / problem.discretization.spacing;
  return std::max(1.0, across / std::max(least, std::round(across / wanted)));
}

/// The largest radius of rings about tips whose spacings are so much wider; 0 without rings [spacings].
double rings_of(const Case& c, double wider) {
  return c.srif || c.growth ? post::widest_ring(c, wider) : 0;
}

/// Two samples, the smaller one as often as its points are too wide; nothing where the larger one's are.
std::optional<post::Samples> samples(const Case& c, const RunSample& run_sample, const plate::UsualSolver& solver,
                                     double all, double points) {
  const bool grows = c.growth.has_value() || !c.srif;
  const double wider = wider_points(c, std::sqrt(all / points));
  const auto reduced = [&](double by, bool factors) {
    return ReducedRun{by == 1 ? wider : wider_points(c, wider * by), factors && c.srif};
  };
  const auto run = [&](const ReducedRun& one) {
    auto found = run_sample(solver, one);
    if (found && one.factors) found->rings = rings_of(c, one.wider);
    return found;
  };
  post::Samples result;
  try {
    std::optional<post::SampleRun> cold, small;
    for (const double by : {2.0, 1.4, 1.0})
      if (!small && (cold = run(reduced(by, false)))) small = run(reduced(by, false));
    if (!small) return {};
    result.small = std::move(*small);
    result.opening = std::max(0.0, cold->seconds() - result.small.seconds());
    auto whole = reduced(1, false);
    whole.solves = true;
    auto large = run(whole);
    if (!large) return {};
    result.large = std::move(*large);
    if (!grows && !(result.factors = run(reduced(1, true)))) return {};
    if (c.analysis.method == Analysis::Method::central_difference) {
      const double time_step = *result.large.summary.analysis.time_step_limit;
      const double begun = result.factors.value_or(result.large).seconds("solve");
      for (double steps = least_steps, taken = 0; taken < long_enough && steps <= most_steps;) {
        if (!(result.longer = run({wider, c.srif.has_value(), steps, time_step}))) return {};
        taken = result.longer->seconds("solve") - begun;
        steps = std::round(steps * std::clamp(1.5 * long_enough / std::max(taken, 1e-4), 2.0, 64.0));
      }
    }
    if (c.analysis.sweep && c.srif) result.longer = run({wider, true, 3 * double(few_frequencies)});
  } catch (const plate::NumericalError&) {
    if (wider == 1) throw;
    return {};
  }
  return result;
}

/// Advances of a quasi-static growth until the cracks are as long as they may be, or have crossed the plate.
double advances_of(const plate::Problem& problem, const fracture::Growth& growth) {
  const auto [low, high] = geometry::bounding_box(problem.outline);
  double longest = 0;
  for (const auto& crack : problem.cracks)
    for (std::size_t i = 1; i < crack.size(); ++i) longest = std::max(longest, (crack[i] - crack[i - 1]).norm());
  const double to = growth.max_length.value_or((high - low).maxCoeff());
  const double advances = std::max(1.0, (to - longest) / (growth.increment * problem.discretization.spacing_at_tips()));
  return std::min(advances, double(growth.max_advances));
}

/// The stable step of the plate, with the damping and the contact that samples are without.
double global_step(double free, const Case& c) {
  if (const auto& impact = c.impact) {
    const double spacing = c.discretization.spacing_at_tips();
    const double point = c.section.mass() * spacing * spacing;
    const double square = impact->stiffness * (1 / impact->mass + 1 / point);
    free = std::min(2 / std::sqrt(4 / (free * free) + square), 0.1 / std::sqrt(square));
  }
  return c.analysis.damping ? plate::damped_step(free, *c.analysis.damping, c.analysis.duration).limit : free;
}

void set_motion(const Case& c, RunEstimate& result, const post::Samples& found) {
  const auto& analysis = c.analysis;
  auto& whole = result.whole;
  if (analysis.sweep) {
    whole.rows = double(analysis.sweep->count), whole.frames = frames_of_period;
    return;
  }
  if (analysis.method == Analysis::Method::lanczos) {
    whole.rows = double(plate::row_grid(grid_options(c)).steps);
  } else {
    result.time_limit = global_step(post::stable_step_of_run(found), c);
    const auto grid = plate::time_grid(grid_options(c), result.time_limit);
    result.time_step = grid.time_step, whole.steps = double(grid.steps);
    whole.rows = whole.steps / double(grid.steps_per_row);
  }
  whole.frames = 2 + (c.output.every ? std::floor(analysis.duration / *c.output.every) : 0);
}

/// Time of the run by which errors of results are estimated, over that of the run: of a ninth of the points, or of the
/// Galerkin plate of half of them beside bonds (measured: 0.09, 0.26).
double of_other_run(const Case& c) {
  return c.discretization.formulation->offers(plate::Feature::horizon) ? 0.3 : 0.1;
}

}  // namespace

double expected_points(const plate::Problem& problem) {
  return geometry::expected_points(problem.outline, geometry::tips(plate::crack_paths(problem)),
                                   problem.discretization.spacing, plate::grading_of(problem, 1));
}

plate::Analysis sampled(plate::Analysis analysis, const plate::UsualSolver& solver, const ReducedRun& reduced,
                        bool grows) {
  if (analysis.kind == Analysis::Kind::static_) {
    analysis.preconditioner = solver.preconditioner;
    if (solver.method == plate::StaticMethod::direct) analysis.method = Analysis::Method::direct;
  }
  if (!reduced.solves && !is_motion(analysis) && !grows) analysis.tolerance = 0.1;
  analysis.time_step.reset();
  if (analysis.sweep)
    analysis.sweep->count = std::min(analysis.sweep->count, std::max(few_frequencies, std::size_t(reduced.steps)));
  if (analysis.damping && analysis.kind == Analysis::Kind::dynamic)
    analysis.damping->stiffness *= 1e-9;  // as dear, without its stable step
  if (analysis.method == Analysis::Method::central_difference)
    analysis.duration = reduced.time_step > 0 ? reduced.steps * reduced.time_step : 1e-9 * analysis.duration;
  return analysis;
}

post::SampleRun sample_run(const Case& c, post::Summary summary, double wider) {
  post::SampleRun result{std::move(summary), wider};
  const auto& analysis = c.analysis;
  if (c.moves()) {
    result.rows = 1 + std::round(analysis.duration / *c.output.history_every);
    result.frames = 2;
  } else if (analysis.sweep) {
    result.rows = double(analysis.sweep->count), result.frames = frames_of_period;
  } else {
    result.frames = analysis.kind == Analysis::Kind::frequencies ? double(analysis.modes) : c.growth ? 2 : 1;
  }
  return result;
}

RunEstimate estimate_cost(const Case& c, const RunSample& run) {
  const auto& analysis = c.analysis;
  const double all = expected_points(c);
  RunEstimate result;
  using enum plate::Preconditioning;
  const bool modes = analysis.kind == Analysis::Kind::frequencies;
  const auto of_modes = c.discretization.formulation->offers(plate::Feature::levels) ? levels : diagonal;
  result.solver = plate::usual_solver(c, modes ? plate::StaticMethod::cg : analysis.static_method(),
                                      modes ? of_modes : analysis.preconditioner, all);
  const bool steps = analysis.method == Analysis::Method::central_difference;
  const bool moves = is_motion(analysis);
  const bool slow = !moves && (result.solver.method != plate::StaticMethod::cg || (modes && of_modes == diagonal));
  std::optional<post::Samples> found;
  const bool adr = slow && result.solver.method == plate::StaticMethod::adr;
  for (const double points : {adr ? few / 3 : slow ? few : steps ? many : some, slow ? some : many, 3 * many})
    if (!found) found = samples(c, run, result.solver, all, points);
  if (!found) found = samples(c, run, result.solver, all, all);
  if (!found) throw plate::Refused({{plate::Subject::spacing, 0, "no sample of the plate can be run: refine"}});

  auto& whole = result.whole;
  result.points = whole.points = post::total_points(*found), result.bonds = post::total_bonds(*found);
  result.sample_points = std::size_t(found->large.points());
  result.multipliers = found->large.summary.multipliers;
  if (!c.unilateral() && !c.pushed() && !c.growth) {  // samples are without what lifts off
    result.linear_theory_off = found->large.summary.linear_theory_off;
    result.deflection_over_thickness = found->large.summary.deflection_over_thickness;
  }
  whole.rings = rings_of(c, 1);
  whole.frames = found->large.frames;
  if (!moves) whole.iterations_order = result.solver.iterations, whole.seconds_order = result.solver.seconds;
  if (moves) set_motion(c, result, *found);
  if (c.grows_at_rest())
    whole.advances = advances_of(c, *c.growth), whole.frames = 1 + whole.advances / double(c.growth->frames_every);
  result.costs = post::estimated_cost(*found, whole);
  if (c.wants_errors()) result.costs.seconds.emplace_back("errors", of_other_run(c) * result.costs.total());
  result.bytes = post::bytes_of_program(c.output.vtk || c.output.hdf5) + post::bytes_of_parts(*found, result.points) +
                 (steps ? 0 : result.solver.bytes) +
                 (c.discretization.formulation == &plate::galerkin ? bytes_while_cells_are_made * result.points : 0) +
                 (c.srif && !c.discretization.tip_spacing ? post::bytes_of_rings(whole.rings) : 0);
  return result;
}

namespace {

std::string of_solution(const RunEstimate& run, const Case& c) {
  if (run.time_step > 0)
    return fmt::format("time step     {:.4g} (stable limit {:.4g})\nsteps         {:.0f}\n", run.time_step,
                       run.time_limit, run.whole.steps);
  if (c.coupled() && c.analysis.kind != Analysis::Kind::static_)
    return fmt::format("solution      Lanczos iteration, {}\n", run.solver.words);
  if (c.analysis.kind == Analysis::Kind::frequencies)
    return fmt::format("solution      Lanczos iteration, about {:.0f} iterations of its solver\n",
                       run.costs.iterations);
  if (c.analysis.kind != Analysis::Kind::static_)
    return fmt::format("solution      Lanczos vectors, about {:.0f}\n", run.costs.iterations);
  const char* each = c.growth         ? " an advance"
                     : c.unilateral() ? " for each try of what soil touches"
                     : c.pushed()     ? ", and a solution for each point that lifts off"
                                      : "";
  return fmt::format("solution      {}, about {:.0f} iterations{}\n", run.solver.words,
                     std::max(1.0, run.costs.iterations), each);
}

std::string of_time(const RunEstimate& run) {
  std::string text = fmt::format("time          {:.2g} s:", run.costs.total());
  for (const auto& [stage, seconds] : run.costs.seconds) text += fmt::format(" {} {:.2g},", stage, seconds);
  text.back() = '\n';
  if (run.whole.advances > 0)
    text += fmt::format("advances      up to {:.0f}, {:.2g} s each\n", run.whole.advances,
                        run.costs.total() / run.whole.advances);
  return text;
}

std::string of_multipliers(const RunEstimate& run) {
  if (!run.multipliers) return "";
  return fmt::format(
      "multipliers   add forces of {:.2g} of the loads with {} points; less with more, as they fall with the spacing\n",
      *run.multipliers, run.sample_points);
}

std::string of_linear_theory(const RunEstimate& run) {
  const auto said = post::error_of_linear_theory(run.linear_theory_off);
  if (said.empty()) return "";
  return fmt::format("linearity     {}; the largest is {:.2g} x thickness with {} points\n", said,
                     run.deflection_over_thickness.value_or(0), run.sample_points);
}

}  // namespace

std::string to_text(const RunEstimate& run, const Case& c) {
  return fmt::format("points        {:.0f}\nbonds         {:.0f}\n", run.points, run.bonds) + of_solution(run, c) +
         of_multipliers(run) + of_linear_theory(run) + of_time(run);
}

namespace {

using geometry::CellBox;

/// Points of the plate in a box, by its cells or by many places in it.
double points_in(const geometry::Outline& outline, CellBox box, const geometry::Cell& size) {
  constexpr long most = 64;  // places along a side
  for (const std::size_t axis : {0, 1})
    box.low[axis] = std::max(box.low[axis], 0L), box.high[axis] = std::min(box.high[axis], size[axis]);
  if (geometry::is_empty(box)) return 0;
  const long across = std::min(most, box.side(0)), up = std::min(most, box.side(1));
  const double dx = double(box.side(0)) / double(across), dy = double(box.side(1)) / double(up);
  long inside = 0;
  for (long j = 0; j < up; ++j)
    for (long i = 0; i < across; ++i)
      inside += geometry::contains(
          outline, {double(box.low[0]) + (double(i) + 0.5) * dx, double(box.low[1]) + (double(j) + 0.5) * dy});
  return double(inside) * dx * dy;
}

ProcessesEstimate of_cells(const plate::Problem& problem, int count) {
  ProcessesEstimate result{count, 0, INFINITY, 0, 0, 0, true};
  for (const auto& one : plate::estimated_parts(problem, count)) {
    result.points = std::max(result.points, one.points),
    result.least_points = std::min(result.least_points, one.points);
    result.seen = std::max(result.seen, one.seen), result.neighbours = std::max(result.neighbours, one.neighbours);
    result.copies = std::max(result.copies, one.seen - one.points);
    result.all_made = one.whole;
  }
  return result;
}

ProcessesEstimate of_lattice(const plate::Problem& problem, int count) {
  const auto& d = problem.discretization;
  const auto partition = plate::partition_of_lattice(problem.outline, d, count);
  const auto [low, high] = geometry::bounding_box(problem.outline);
  const auto outline = geometry::to_lattice(problem.outline, {low, d.spacing});
  const geometry::Point sides = (high - low) / d.spacing;
  const geometry::Cell size{long(std::ceil(sides.x() - 1e-9)), long(std::ceil(sides.y() - 1e-9))};
  const long margin = plate::margin_of_part(d), reach = long(std::floor(d.horizon_ratio));
  ProcessesEstimate result{count, 0, INFINITY, 0, 0, 0, false};
  for (int rank = 0; rank < count; ++rank) {
    const auto& box = partition.box(rank);
    const double own = points_in(outline, box, size);
    double copies = 0, neighbours = 0;
    for (int other = 0; other < count; ++other) {
      const auto wide = box.grown(reach), &theirs = partition.box(other);
      const auto both = geometry::common(wide, theirs);
      if (other == rank || geometry::is_empty(both)) continue;
      const double found = points_in(outline, both, size);
      copies += found, neighbours += found > 0;
    }
    result.points = std::max(result.points, own), result.least_points = std::min(result.least_points, own);
    result.seen = std::max(result.seen, points_in(outline, box.grown(margin), size));
    result.copies = std::max(result.copies, copies), result.neighbours = std::max(result.neighbours, neighbours);
  }
  return result;
}

}  // namespace

ProcessesEstimate estimated_processes(const plate::Problem& problem, int count) {
  return (problem.discretization.formulation == &plate::galerkin ? of_cells : of_lattice)(problem, count);
}

namespace {

/// Number of multigrid plates that are coarser than a Galerkin plate of so many points; the last has 4,000 points at
/// most.
double coarser_plates(double points) {
  return std::max(0.0, std::ceil(std::log2(points / 4000) / 2));
}

/// Messages and numbers of a product of the stiffness and what belongs to it.
std::pair<double, double> exchanged(const RunEstimate& run, const Case& c) {
  using enum plate::Preconditioning;
  const auto inverse = c.moves() ? diagonal : run.solver.preconditioner;
  if (c.discretization.formulation == &plate::galerkin) {
    // displacements; with coarser plates counted, two and three of them: 19 and 28 messages, 13 states of the finest
    if (inverse == levels) return {9.5 * coarser_plates(run.points), 13 * 3};
    return {1, 3};
  }
  // displacements, then dilatations; with two levels five of them, the rest and the coarse plate's answer
  if (inverse == two_level) return {12, 5 * (3 + 1) + 6};
  return {2, 3 + 1};
}

}  // namespace

SingleProcessRun run_by_one(const RunEstimate& run, const Case& c) {
  const double program = post::bytes_of_program(c.output.vtk || c.output.hdf5);
  const auto [messages, numbers] = exchanged(run, c);
  const bool direct = !c.moves() && run.solver.method == plate::StaticMethod::direct;
  const double factor = direct ? run.solver.bytes : 0;
  return {run.points, program, run.bytes - program, factor, run.costs.seconds, c.moves(), messages, numbers};
}

double bytes_of_process(const ProcessesEstimate& processes, const SingleProcessRun& run) {
  // of Open MPI and PETSc, and of what solves coarse plates: measured, where a plate has few points
  const double libraries = run.moves ? 43e6 : 69e6;
  const double others = processes.all_made ? bytes_while_cells_are_made * (run.points - processes.seen) : 0;
  constexpr double by_mumps = 1.6;  // of a factor by CHOLMOD: measured 1.58 of 70,000 graded points, 1.6 of a lattice
  const double factor = by_mumps * run.factor * processes.points / run.points;
  return libraries + run.program + (run.bytes - run.factor) * processes.seen / run.points + factor + others;
}

double seconds_of_processes(const ProcessesEstimate& processes, const SingleProcessRun& run) {
  double result = 0;
  for (const auto& [stage, seconds] : run.seconds)
    result += seconds * (stage == "setting up" ? processes.seen : processes.points) / run.points;
  return result;
}

std::string to_text(const ProcessesEstimate& processes, const SingleProcessRun& run) {
  constexpr double giga = 1e9, kilo = 1e3;
  const double bytes = bytes_of_process(processes, run);
  std::string text = fmt::format(
      "processes     {}, of {:.0f} to {:.0f} points, which see up to {:.0f}\n"
      "memory        {:.3g} GB each at its peak, {:.3g} GB in all\n"
      "time          {:.2g} s where each has cores of its own, without exchange\n",
      processes.count, processes.least_points, processes.points, processes.seen, bytes / giga,
      bytes * processes.count / giga, seconds_of_processes(processes, run));
  if (processes.count > 1)
    text += fmt::format("exchange      up to {:.0f} messages with {:.3g} kB to each {}\n",
                        run.messages * processes.neighbours, processes.copies * run.numbers * sizeof(double) / kilo,
                        run.moves ? "a step" : "an iteration");
  return text;
}

}  // namespace cases
