#include "post/studies/accuracy/path.hpp"

#include "plate/model/problem.hpp"
#include "post/factors/plate_factors.hpp"

namespace post {
namespace {

/// From any tip to what disturbs its field; the side of the plate without tips.
double exact_clear_distance(const plate::Problem& problem, double side) {
  plate::Problem fine = problem;  // bends count, however slight
  fine.discretization.tip_spacing = 1e-6 * side;
  const auto paths = plate::crack_paths(problem);
  return std::min(side, least_clear_distance(fine, paths, geometry::tips(paths)));
}

/// Of the smallest hole or part of the plate that is held; none without them.
std::optional<double> least_radius(const plate::Problem& problem) {
  std::optional<double> result;
  auto shapes = problem.outline.holes;
  for (const auto& support : problem.supports)
    if (support.patch) shapes.push_back(*support.patch);
  const auto take = [&](double radius) { result = std::min(result.value_or(radius), radius); };
  for (const auto& hole : shapes) {
    if (const auto* circle = std::get_if<geometry::Circle>(&hole)) {
      take(circle->radius);
      continue;
    }
    const auto [low, high] = geometry::bounding_box({std::get<geometry::Polygon>(hole), {}});
    take((high - low).minCoeff() / 2);
  }
  return result;
}

}  // namespace

plate::Discretization discretization_of(const plate::Problem& problem, bool moves, double size) {
  const auto [low, high] = geometry::bounding_box(problem.outline);
  const geometry::Point sides = high - low;
  const double layer = problem.section.layer();
  plate::Discretization result = problem.discretization;
  result.spacing = size * sides.minCoeff() / (moves ? 28 : 10);
  result.tip_spacing = std::min(
      size * size * std::min(exact_clear_distance(problem, sides.maxCoeff()) / 20, 0.63 * layer), result.spacing);
  result.hole_spacing.reset();
  if (const auto radius = least_radius(problem)) result.hole_spacing = std::min(size * *radius / 4, result.spacing);
  result.spacing_growth = 0.28 * size;
  return result;
}

}  // namespace post
