#include "fracture/runs/shared/foretold_processes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fracture/runs/foretell.hpp"
#include "geometry/lattice/boxes.hpp"
#include "plate/bonds/part_of_lattice.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/galerkin/shared/foretold_parts.hpp"
#include "plate/model/problem.hpp"

namespace fracture {
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

ForetoldProcesses of_cells(const plate::Problem& problem, int count) {
  ForetoldProcesses result{count, 0, INFINITY, 0, 0, 0, true};
  for (const auto& one : plate::foretold_parts(problem, count)) {
    result.points = std::max(result.points, one.points),
    result.least_points = std::min(result.least_points, one.points);
    result.seen = std::max(result.seen, one.seen), result.neighbours = std::max(result.neighbours, one.neighbours);
    result.copies = std::max(result.copies, one.seen - one.points);
    result.all_made = one.whole;
  }
  return result;
}

ForetoldProcesses of_lattice(const plate::Problem& problem, int count) {
  const auto& d = problem.discretization;
  const auto partition = plate::partition_of_lattice(problem.outline, d, count);
  const auto [low, high] = geometry::bounding_box(problem.outline);
  const auto outline = geometry::to_lattice(problem.outline, {low, d.spacing});
  const geometry::Point sides = (high - low) / d.spacing;
  const geometry::Cell size{long(std::ceil(sides.x() - 1e-9)), long(std::ceil(sides.y() - 1e-9))};
  const long margin = plate::margin_of_part(d), reach = long(std::floor(d.horizon_ratio));
  ForetoldProcesses result{count, 0, INFINITY, 0, 0, 0, false};
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

ForetoldProcesses foretold_processes(const plate::Problem& problem, int count) {
  return (problem.discretization.formulation == &plate::galerkin ? of_cells : of_lattice)(problem, count);
}

namespace {

/// Of the plates that are coarser than a Galerkin plate of so many points; the last has 4,000 points at most.
double coarser_plates(double points) {
  return std::max(0.0, std::ceil(std::log2(points / 4000) / 2));
}

/// Messages and numbers of a product of the stiffness and what belongs to it.
std::pair<double, double> exchanged(const ForetoldRun& run, const RunPlan& plan) {
  using enum plate::Preconditioning;
  const auto inverse = plan.moves() ? diagonal : run.solver.preconditioner;
  if (plan.problem.discretization.formulation == &plate::galerkin) {
    // displacements; with coarser plates counted, two and three of them: 19 and 28 messages, 13 states of the finest
    if (inverse == levels) return {9.5 * coarser_plates(run.points), 13 * 3};
    return {1, 3};
  }
  // displacements, then dilatations; with two levels five of them, the rest and the coarse plate's answer
  if (inverse == two_level) return {12, 5 * (3 + 1) + 6};
  return {2, 3 + 1};
}

}  // namespace

RunByOne run_by_one(const ForetoldRun& run, const RunPlan& plan) {
  const double program = post::bytes_of_program(plan.fields || plan.states);
  const auto [messages, numbers] = exchanged(run, plan);
  const bool direct = !plan.moves() && run.solver.method == plate::StaticMethod::direct;
  const double factor = direct ? run.solver.bytes : 0;
  return {run.points, program, run.bytes - program, factor, run.costs.seconds, plan.moves(), messages, numbers};
}

double bytes_of_process(const ForetoldProcesses& processes, const RunByOne& run) {
  // of Open MPI and PETSc, and of what solves coarse plates: measured, where a plate has few points
  const double libraries = run.moves ? 43e6 : 69e6;
  const double others = processes.all_made ? bytes_while_cells_are_made * (run.points - processes.seen) : 0;
  constexpr double by_mumps = 1.6;  // of a factor by CHOLMOD: measured 1.58 of 70,000 graded points, 1.6 of a lattice
  const double factor = by_mumps * run.factor * processes.points / run.points;
  return libraries + run.program + (run.bytes - run.factor) * processes.seen / run.points + factor + others;
}

double seconds_of_processes(const ForetoldProcesses& processes, const RunByOne& run) {
  double result = 0;
  for (const auto& [stage, seconds] : run.seconds)
    result += seconds * (stage == "setting up" ? processes.seen : processes.points) / run.points;
  return result;
}

std::string to_text(const ForetoldProcesses& processes, const RunByOne& run) {
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

}  // namespace fracture
