#include "cases/input/accuracy_path.hpp"

#include "post/factors/plate_factors.hpp"

namespace cases {
namespace {

/// From any tip to what disturbs its field; the side of the plate without tips.
double exact_clear_distance(const Case& c, double side) {
  Case fine = c;  // bends count, however slight
  fine.discretization.tip_spacing = 1e-6 * side;
  const auto paths = plate::crack_paths(c);
  return std::min(side, post::least_clear_distance(fine, paths, geometry::tips(paths)));
}

/// Of the smallest hole; none without holes.
std::optional<double> least_radius(const geometry::Outline& outline) {
  std::optional<double> result;
  const auto take = [&](double radius) { result = std::min(result.value_or(radius), radius); };
  for (const auto& hole : outline.holes) {
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

plate::Discretization discretization_of(const Case& c, double size) {
  const auto [low, high] = geometry::bounding_box(c.outline);
  const geometry::Point sides = high - low;
  const double layer = c.section.layer();
  plate::Discretization result = c.discretization;
  result.spacing = size * sides.minCoeff() / (c.analysis.kind == Analysis::Kind::dynamic ? 28 : 10);
  result.tip_spacing =
      std::min(size * size * std::min(exact_clear_distance(c, sides.maxCoeff()) / 20, 0.63 * layer), result.spacing);
  result.hole_spacing.reset();
  if (const auto radius = least_radius(c.outline)) result.hole_spacing = std::min(size * *radius / 4, result.spacing);
  result.spacing_growth = 0.28 * size;
  return result;
}

}  // namespace cases
