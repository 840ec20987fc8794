#include "post/report/cost_model.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/numerical_method.hpp"
#include "plate/model/space.hpp"
#include "plate/solve/analysis.hpp"
#include "post/files/summary.hpp"

namespace post {
namespace {

constexpr double vector_bytes = plate::unknowns_per_point * sizeof(double);  // one state or force

}  // namespace

std::vector<ScenePart> scene(const plate::Formulation& plate, const plate::Analysis& analysis, const Given& given) {
  const double points = double(plate.cloud().plate_points), all = double(plate.cloud().size());
  const bool mixed = analysis.precision == plate::Analysis::Precision::mixed;
  using enum plate::Analysis::Method;
  const auto method = analysis.method;

  std::vector<ScenePart> parts;
  for (const auto& part : plate::memory_of(plate, mixed))
    parts.push_back({part.name, part.stage, part.bytes / points, 0});
  if (method == central_difference)
    parts.push_back({mixed ? "central differences: state, velocity; state and force in single precision"
                           : "central differences: state, velocity, force",
                     "solve", 3 * vector_bytes * all / points, 0});
  else if (method == adr)
    parts.push_back({"adaptive dynamic relaxation: 7 vectors", "solve", 7 * vector_bytes * all / points, 0});
  else if (method == cg || method == direct)
    parts.push_back({"conjugate gradients: 6 vectors, without a factor", "solve", 6 * vector_bytes * all / points, 0});
  else if (analysis.kind != plate::Analysis::Kind::frequencies)
    parts.push_back({"72 Lanczos vectors, their forces and modes, without a factor", "solve",
                     3 * 72 * vector_bytes * all / points, 0});
  else
    parts.push_back({"Lanczos iteration and conjugate gradients", "solve",
                     (4 * double(analysis.modes) + 16) * vector_bytes * all / points, 0});
  parts.push_back(
      {given.factors ? "intensity factors, probes, energies" : "probes, energies, largest values", "srif", 0, 0});
  constexpr double vtk_bytes = 560;  // measured 560 to 570 at 40,000 and 161,000 points
  parts.push_back({"output", "output", 3 * vector_bytes + (given.fields ? vtk_bytes : 0), 0});
  return parts;
}

Summary about(const plate::Formulation& plate, const plate::Analysis& analysis, const Given& given) {
  Summary summary;
  summary.formulation = plate.kind().name;
  summary.points = plate.cloud().plate_points;
  summary.bonds = plate.bonds();
  summary.fictitious_points = plate.fictitious_points();
  summary.fictitious_bonds = plate.fictitious_bonds();
  summary.spacing = plate.discretization().spacing;
  summary.horizon = plate.discretization().horizon();
  if (const auto match = plate.matched())
    summary.position_aware = {match->exact, match->blended, match->arbitrary_horizon};
  summary.scene = scene(plate, analysis, given);
  summary.analysis.kind = analysis.kind;
  return summary;
}

namespace {

const std::vector<std::string> setting_up{"geometry", "families", "parameters"};

double of_stages(const SampleRun& run, const std::vector<std::string>& stages) {
  double sum = 0;
  for (const auto& stage : stages) sum += run.seconds(stage);
  return sum;
}

/// Interpolates a cost as proportional to the points, plus a constant.
double by_points(const Samples& s, double points, double small, double large) {
  return TwoTerms({s.small.points(), 1, small}, {s.large.points(), 1, large})(points, 1);
}

double by_area(const Samples& s, double small, double large) {
  const double a = 1 / s.small.spacing, b = 1 / s.large.spacing;
  return TwoTerms({a * a, a, small}, {b * b, b, large})(1, 1);
}

/// Computing time of the factors: of rings of points about the tips, and at each row of the energies of all points.
double of_factors(const Samples& s, const RunSize& whole) {
  const auto& without = s.large;
  const auto& with = s.factors.value_or(s.large);
  const double per_point = without.seconds("srif") / without.rows / without.points();
  constexpr double order = 1.25;  // measured 0.7 of cells, 1.4 to 1.9 of bonds, from 8 to 24 spacings
  const double wider = with.rings > 0 ? std::pow(whole.rings / with.rings, order) : 1;
  const double once = std::max(0.0, with.seconds("srif") - per_point * with.points() * with.rows);
  double result = once * wider + per_point * whole.points * whole.rows;
  if (!s.longer || s.longer->rows <= with.rows) return result;
  const double row = (s.longer->seconds("srif") - with.seconds("srif")) / (s.longer->rows - with.rows);
  return result + std::max(0.0, row - per_point * with.points()) * wider * whole.rows;
}

double of_solution(const Samples& s, const RunSize& whole) {
  const double more = whole.points / s.large.points();
  const auto& with = s.factors.value_or(s.large);
  if (!s.longer || s.longer->steps() <= with.steps())
    return s.large.seconds("solve") * std::pow(more, whole.seconds_order);
  const double step = (s.longer->seconds("solve") - with.seconds("solve")) / (s.longer->steps() - with.steps());
  const double once = std::max(0.0, with.seconds("solve") - step * with.steps());
  return more * (once + std::max(0.0, step) * whole.steps);
}

double of_files(const Samples& s, const RunSize& whole) {
  const double frames = whole.frames / s.large.frames;
  return s.opening + by_points(s, frames * whole.points, s.small.seconds("output"), s.large.seconds("output"));
}

}  // namespace

TwoTerms::TwoTerms(const Value& first, const Value& second) {
  const double determinant = first.u * second.v - second.u * first.v;
  if (determinant != 0) {
    a_ = (first.is * second.v - second.is * first.v) / determinant;
    b_ = (first.u * second.is - second.u * first.is) / determinant;
  }
  if (determinant == 0 || b_ < 0) a_ = second.u > 0 ? second.is / second.u : 0, b_ = 0;
  if (a_ < 0) a_ = 0, b_ = second.v > 0 ? second.is / second.v : 0;
}

double SampleRun::seconds(const std::string& stage) const {
  const auto found = std::ranges::find(summary.seconds, stage, &std::pair<std::string, double>::first);
  return found == summary.seconds.end() ? 0 : share * found->second;
}

double CostEstimate::total() const {
  return std::accumulate(seconds.begin(), seconds.end(), 0.0, [](double sum, const auto& s) { return sum + s.second; });
}

double total_points(const Samples& s) {
  return by_area(s, s.small.points(), s.large.points());
}

double total_bonds(const Samples& s) {
  return by_area(s, double(s.small.summary.bonds), double(s.large.summary.bonds));
}

double bytes_of_parts(const Samples& s, double points) {
  const auto of = [](const SampleRun& run) {
    double sum = 0;
    for (const auto& part : run.summary.scene)
      if (part.name != "factor") sum += part.bytes_per_point * run.points();
    return sum;
  };
  return by_area(s, of(s.small), of(s.large)) / total_points(s) * points;
}

double bytes_of_rings(double radius) {
  return 52e3 * radius * radius;
}

double bytes_of_program(bool fields) {
  return fields ? 37e6 : 14e6;
}

double stable_step_of_run(const Samples& s) {
  const auto square = [](const SampleRun& run) {
    return std::pow(run.summary.analysis.time_step_limit.value_or(0), -2);
  };
  const auto of = [](const SampleRun& run) { return 1 / run.spacing / run.spacing; };
  return 1 / std::sqrt(TwoTerms({of(s.small), 1, square(s.small)}, {of(s.large), 1, square(s.large)})(1, 1));
}

CostEstimate estimated_cost(const Samples& s, const RunSize& whole) {
  CostEstimate result;
  const double more = whole.points / s.large.points();
  result.iterations = double(s.large.summary.analysis.iterations.value_or(0)) * std::pow(more, whole.iterations_order);
  result.seconds = {
      {"setting up", by_points(s, whole.points, of_stages(s.small, setting_up), of_stages(s.large, setting_up))},
      {"solution", of_solution(s, whole)},
      {"factors and energies", of_factors(s, whole)},
      {"files", of_files(s, whole)}};
  result.files = by_points(s, whole.points * whole.frames / s.large.frames, s.small.files, s.large.files);
  if (whole.advances > 0) {
    const double in_sample = 1 + double(s.large.summary.growth ? s.large.summary.growth->advances : 0);
    for (auto& [stage, seconds] : result.seconds)
      if (stage != "files") seconds *= whole.advances / in_sample;
  }
  return result;
}

}  // namespace post
