#include "plate/model/loading/cubature.hpp"

#include <cmath>

namespace plate {

using geometry::Point;

struct Cubature::Triangle {
  Point a, b, c;
  double area() const { return ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x()) / 2; }
};

Integral& Integral::operator+=(const Integral& other) {
  value += other.value, first += other.first, size += other.size, error += other.error;
  return *this;
}

/// By the middles of the sides: exact to the second order.
Integral Cubature::rule(const Triangle& triangle, const Point& about) {
  Integral result;
  const auto& [a, b, c] = triangle;
  for (const Point& x : {Point((a + b) / 2), Point((b + c) / 2), Point((c + a) / 2)}) {
    const double f = f_(x), share = f * triangle.area() / 3;
    largest_ = std::max(largest_, std::abs(f));
    result.value += share, result.first += share * (x - about), result.size += std::abs(share);
  }
  return result;
}

Integral Cubature::refined(const Triangle& triangle, const Integral& coarse, const Point& about, int depth) {
  constexpr double tolerance = 1e-4;
  constexpr int deepest = 5;
  const auto& [a, b, c] = triangle;
  const Point ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
  const std::array<Triangle, 4> parts{{{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}};
  std::array<Integral, 4> fine;
  Integral result;
  for (std::size_t i = 0; i < 4; ++i) result += fine[i] = rule(parts[i], about);
  const double change = std::abs(result.value - coarse.value);
  if (change <= tolerance * largest_ * std::abs(triangle.area())) return result;
  if (depth == deepest) {
    result.error = change;
    return result;
  }
  result = {};
  for (std::size_t i = 0; i < 4; ++i) result += refined(parts[i], fine[i], about, depth + 1);
  return result;
}

Integral Cubature::operator()(const std::vector<Point>& ring, const Point& about) {
  Point middle(0, 0);
  for (const Point& x : ring) middle += x / double(ring.size());
  largest_ = 0;
  std::vector<std::pair<Triangle, Integral>> parts;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Triangle triangle{middle, ring[i], ring[(i + 1) % ring.size()]};
    parts.emplace_back(triangle, rule(triangle, about));
  }
  Integral result;
  for (const auto& [triangle, coarse] : parts) result += refined(triangle, coarse, about, 0);
  return result;
}

}  // namespace plate
