#include "geometry/shape/patch.hpp"

#include <algorithm>
#include <numbers>

#include "geometry/shape/predicates.hpp"

namespace geometry {
namespace {

Ring ring_of(const Polygon& polygon) {
  Ring ring = polygon.vertices;
  if (signed_area(ring) < 0) std::ranges::reverse(ring);
  return ring;
}

Ring ring_of(const Circle& circle) {
  constexpr int count = 512;  // the second moments are 2.5e-5 too large
  const double angle = 2 * std::numbers::pi / count, radius = circle.radius * std::sqrt(angle / std::sin(angle));
  Ring ring;
  for (int i = 0; i < count; ++i)
    ring.push_back(circle.centre + radius * Point(std::cos((i + 0.5) * angle), std::sin((i + 0.5) * angle)));
  return ring;
}

/// The part of a ring to the left of the line from a to b.
Ring left_of(const Ring& ring, const Point& a, const Point& b) {
  Ring kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &p = ring[i], &q = next(ring, i);
    const double of_p = cross(b - a, p - a), of_q = cross(b - a, q - a);
    if (of_p >= 0) kept.push_back(p);
    if ((of_p >= 0) != (of_q >= 0)) kept.push_back(p + (q - p) * (of_p / (of_p - of_q)));
  }
  return kept;
}

bool near(const Ring& ring, const Ring& cell) {
  const auto [low, high] = bounding_box(cell);
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (boxes_meet(low, high, ring[i], next(ring, i))) return true;
  return false;
}

}  // namespace

Hole moved(Hole shape, const Point& by) {
  if (auto* circle = std::get_if<Circle>(&shape)) circle->centre += by;
  if (auto* polygon = std::get_if<Polygon>(&shape))
    for (auto& x : polygon->vertices) x += by;
  return shape;
}

AreaMoments moments(const Ring& ring, const Point& about) {
  AreaMoments result;
  for (std::size_t i = 0; i < ring.size(); ++i) {  // triangles (about, a, b)
    const Point a = ring[i] - about, b = next(ring, i) - about, sum = a + b;
    const double area = cross(a, b) / 2;
    result.area += area;
    result.first += area / 3 * sum;
    result.second += area / 12 * (a * a.transpose() + b * b.transpose() + sum * sum.transpose());
  }
  return result;
}

Patch::Patch(const Hole& shape) : ring_(std::visit([](const auto& one) { return ring_of(one); }, shape)) {}

Ring Patch::common(const Ring& cell) const {
  if (!near(ring_, cell)) return position(ring_, cell.front()) > 0 ? cell : Ring{};
  Ring piece = ring_;
  for (std::size_t i = 0; i < cell.size() && !piece.empty(); ++i) piece = left_of(piece, cell[i], next(cell, i));
  return piece;
}

bool Patch::meets(const Outline& outline) const {
  const auto inside = [&](const Point& x) { return contains(outline, x) && position(ring_, x) > 0; };
  constexpr int count = 40;
  auto [low, high] = bounding_box(outline);
  for (const Point& x : ring_)
    if (contains(outline, x)) return true;
  for (const Point& x : outline.outer.vertices)
    if (position(ring_, x) > 0) return true;
  const auto [own_low, own_high] = bounding_box(ring_);
  low = low.cwiseMax(own_low), high = high.cwiseMin(own_high);
  if (!(low.array() < high.array()).all()) return false;
  for (int i = 0; i < count * count; ++i)
    if (inside(low + (high - low).cwiseProduct(Point(i % count + 0.5, i / count + 0.5) / count))) return true;
  return false;
}

}  // namespace geometry
