#include "post/studies/foretold.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace post {
namespace {

const std::vector<std::string> setting_up{"geometry", "families", "parameters"};

double of_stages(const SampleRun& run, const std::vector<std::string>& stages) {
  double sum = 0;
  for (const auto& stage : stages) sum += run.seconds(stage);
  return sum;
}

/// In proportion to the points, and something for any number of them.
double by_points(const Samples& s, double points, double small, double large) {
  return TwoTerms({s.small.points(), 1, small}, {s.large.points(), 1, large})(points, 1);
}

double by_area(const Samples& s, double small, double large) {
  const double a = 1 / s.small.spacing, b = 1 / s.large.spacing;
  return TwoTerms({a * a, a, small}, {b * b, b, large})(1, 1);
}

/// Of the factors: rings of points about the tips, and at each row the energies of all points.
double of_factors(const Samples& s, const WholeRun& whole) {
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

double of_solution(const Samples& s, const WholeRun& whole) {
  const double more = whole.points / s.large.points();
  const auto& with = s.factors.value_or(s.large);
  if (!s.longer || s.longer->steps() <= with.steps())
    return s.large.seconds("solve") * std::pow(more, whole.seconds_order);
  const double step = (s.longer->seconds("solve") - with.seconds("solve")) / (s.longer->steps() - with.steps());
  const double once = std::max(0.0, with.seconds("solve") - step * with.steps());
  return more * (once + std::max(0.0, step) * whole.steps);
}

double of_files(const Samples& s, const WholeRun& whole) {
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

double Foretold::total() const {
  return std::accumulate(seconds.begin(), seconds.end(), 0.0, [](double sum, const auto& s) { return sum + s.second; });
}

double whole_points(const Samples& s) {
  return by_area(s, s.small.points(), s.large.points());
}

double whole_bonds(const Samples& s) {
  return by_area(s, double(s.small.summary.bonds), double(s.large.summary.bonds));
}

double whole_parts(const Samples& s, double points) {
  const auto of = [](const SampleRun& run) {
    double sum = 0;
    for (const auto& part : run.summary.scene)
      if (part.name != "factor") sum += part.bytes_per_point * run.points();
    return sum;
  };
  return by_area(s, of(s.small), of(s.large)) / whole_points(s) * points;
}

double bytes_of_rings(double radius) {
  return 52e3 * radius * radius;
}

double bytes_of_program(bool fields) {
  return fields ? 37e6 : 14e6;
}

double whole_time_step(const Samples& s) {
  const auto square = [](const SampleRun& run) {
    return std::pow(run.summary.analysis.time_step_limit.value_or(0), -2);
  };
  const auto of = [](const SampleRun& run) { return 1 / run.spacing / run.spacing; };
  return 1 / std::sqrt(TwoTerms({of(s.small), 1, square(s.small)}, {of(s.large), 1, square(s.large)})(1, 1));
}

Foretold foretold(const Samples& s, const WholeRun& whole) {
  Foretold result;
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
