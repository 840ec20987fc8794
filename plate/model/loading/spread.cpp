#include "plate/model/loading/spread.hpp"

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

#include "geometry/cells/tessellation.hpp"
#include "geometry/shape/patch.hpp"

namespace plate {
namespace {

using geometry::Point;
using Ring = std::vector<Point>;

/// What a pressure does to a piece of the plate: its force, and the moment of it, int p x dA, about a place.
struct Thrust {
  double force = 0;
  Point moment{0, 0};
};

/// Throws where a formula has no value: where it is not finite, and where only rounding makes a number of what has no
/// limit, so that what is next to it, a millionth of `size` away, is smaller by orders.
void require_value(const Formula& formula, const Point& x, double usual, double size) {
  constexpr double near = 1e-6, orders = 1e-3;
  const double value = std::abs(formula(x));
  if (!std::isfinite(value)) throw NotFinite(formula, x);
  if (!(usual < near * value)) return;
  const auto beside = [&](double dx, double dy) { return std::abs(formula(x + near * size * Point(dx, dy))); };
  const double most = std::max({beside(1, 0.7), beside(-1, 0.7), beside(1, -0.7), beside(-1, -0.7)});
  if (most < orders * value) throw NotFinite(formula, x);
}

/// By the middles of the sides of the triangles that a piece makes with its middle: exact to the second order.
Thrust thrust_of_formula(const Load& load, const Ring& piece, const Point& about) {
  Thrust result;
  Point middle(0, 0);
  for (const Point& x : piece) middle += x / double(piece.size());
  const double size = (piece.front() - middle).norm();
  require_value(load.formula, middle, std::abs(load.formula(piece.front())), size);
  const double usual = std::abs(load.formula(middle));
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Point &a = piece[i], &b = piece[(i + 1) % piece.size()];
    const double area = ((a - middle).x() * (b - middle).y() - (a - middle).y() * (b - middle).x()) / 2;
    for (const Point& x : {Point((a + b) / 2), Point((b + middle) / 2), Point((middle + a) / 2)}) {
      require_value(load.formula, x, usual, size);
      const double force = area / 3 * load.pressure(x);
      result.force += force, result.moment += force * (x - about);
    }
  }
  return result;
}

Thrust thrust(const Load& load, const Ring& piece, const Point& about) {
  if (piece.empty()) return {};
  if (load.formula.given()) return thrust_of_formula(load, piece, about);
  const auto [area, first, second] = geometry::moments(piece, about);
  const double p = load.pressure(about);
  return {p * area + load.gradient.dot(first), p * first + second * load.gradient};
}

std::optional<geometry::Patch> patch_of(const Load& load) {
  return load.patch ? std::optional<geometry::Patch>(*load.patch) : std::nullopt;
}

template <std::size_t N>
void add_cell(const Load& load, const std::optional<geometry::Patch>& patch, const std::array<std::uint32_t, N>& cell,
              const std::vector<Point>& positions, Forces& forces) {
  Ring ring;
  Point middle(0, 0);
  for (const auto k : cell) ring.push_back(positions[k]), middle += positions[k] / double(N);
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const Point& x : ring) spread += (x - middle) * (x - middle).transpose();
  const auto [force, moment] = thrust(load, patch ? patch->common(ring) : ring, middle);
  const Point slope = spread.inverse() * moment;
  for (std::size_t i = 0; i < N; ++i)
    forces(0, Eigen::Index(cell[i])) += force / double(N) + slope.dot(ring[i] - middle);
}

}  // namespace

Eigen::Vector3d moved_force(double force, const Point& lever) {
  return {force, force * lever.y(), -force * lever.x()};
}

void add_pressure(const Load& load, const geometry::Cloud& cloud, Forces& forces) {
  const auto patch = patch_of(load);
  const double side = cloud.units.spacing, half = side / 2;
  for (std::size_t k = 0; k < cloud.plate_points; ++k) {
    const Point& x = cloud.positions[k];
    const Ring cell{x + Point(-half, -half), x + Point(half, -half), x + Point(half, half), x + Point(-half, half)};
    const auto [force, moment] = thrust(load, patch ? patch->common(cell) : cell, x);
    const double share = cloud.areas[k] / (side * side);
    forces.col(Eigen::Index(k)) += share * Eigen::Vector3d(force, moment.y(), -moment.x());
  }
}

void add_pressure(const Load& load, const geometry::Tessellation& cells, Forces& forces) {
  const auto patch = patch_of(load);
  for (const auto& square : cells.squares) add_cell(load, patch, square, cells.positions, forces);
  for (const auto& triangle : cells.triangles) add_cell(load, patch, triangle, cells.positions, forces);
}

std::vector<LinePiece> line_pieces(const geometry::Polyline& line, const Ring& positions, std::size_t count,
                                   double spacing) {
  std::vector<LinePiece> result;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Point &from = line[i], &to = line[i + 1];
    std::vector<std::size_t> near;
    for (std::size_t k = 0; k < count; ++k)
      if (geometry::distance(geometry::Polyline{from, to}, positions[k]) < 2 * spacing) near.push_back(k);
    if (near.empty()) throw std::invalid_argument("a line has no point of the plate within two spacings");
    const int pieces = std::max(1, int(std::ceil(8 * (to - from).norm() / spacing - 1e-6)));
    for (int n = 0; n < pieces; ++n) {
      const Point middle = from + (n + 0.5) / pieces * (to - from);
      const auto away = [&](std::size_t k) { return (positions[k] - middle).squaredNorm(); };
      const auto k = *std::ranges::min_element(near, [&](std::size_t a, std::size_t b) { return away(a) < away(b); });
      result.push_back({k, middle, (to - from) / pieces});
    }
  }
  return result;
}

void add_line_load(const Load& load, const Ring& positions, std::size_t count, double spacing, Forces& forces) {
  for (const auto& [k, middle, way] : line_pieces(load.along, positions, count, spacing))
    forces.col(Eigen::Index(k)) += moved_force(load.value * way.norm(), middle - positions[k]);
}

}  // namespace plate
