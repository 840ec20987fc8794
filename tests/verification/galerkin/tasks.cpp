// Bodies, loads and answers of plane problems by points.
#include "tests/verification/galerkin/tasks.hpp"

#include <cmath>
#include <limits>

#include "tests/verification/galerkin/plate.hpp"

namespace galerkin_systems {
namespace {

using Eigen::Vector2d;

constexpr double open = std::numeric_limits<double>::quiet_NaN();

Vector2d clamped_left(const Vector2d& s) {
  return s.x() == 0 ? Vector2d(0, 0) : Vector2d(open, open);
}

int point_of(const Grid& g, const Vector2d& s) {
  return int(std::lround(s.y() * g.rows)) * (g.columns + 1) + int(std::lround(s.x() * g.columns));
}

}  // namespace

Task cook() {
  const auto map = [](const Vector2d& s) { return Vector2d(48 * s.x(), 44 * s.x() + s.y() * (44 - 28 * s.x())); };
  const auto traction = [](const Vector2d& s) { return s.x() == 1 ? Vector2d(0, 1.0 / 16) : Vector2d(0, 0); };
  return {map, clamped_left, traction, {1, 1}};
}

Task punched_block() {
  const auto held = [](const Vector2d& s) {
    const bool pressed = s.y() == 1 && s.x() <= 0.5;
    return Vector2d(s.x() == 0 || pressed ? 0 : open, s.y() == 0 ? 0 : open);
  };
  const auto traction = [](const Vector2d& s) { return Vector2d(0, s.y() == 1 && s.x() < 0.5 ? -1 : 0); };
  return {[](const Vector2d& s) { return s; }, held, traction, {0, 1}};
}

Task cantilever() {
  const auto traction = [](const Vector2d& s) { return Vector2d(0, s.x() == 1 ? 1 : 0); };
  return {[](const Vector2d& s) { return Vector2d(8 * s.x(), 2 * s.y()); }, clamped_left, traction, {1, 1}};
}

Placed placed(const Task& task, const Grid& grid, Reach reach) {
  const Lattice unit{1, 1, grid.columns, grid.rows, grid.perturbation, reach};
  return {body(unit, task.map), body(unit).points};
}

Eigen::VectorXd loads(const Task& task, const Placed& points) {
  Eigen::VectorXd f = Eigen::VectorXd::Zero(2 * points.places.cols());
  for (const auto& [from, to] : points.body.outline) {
    const double length = (points.body.points.col(to) - points.body.points.col(from)).norm();
    const Vector2d force = length * task.traction((points.places.col(from) + points.places.col(to)) / 2);
    f.segment<2>(2 * from) += force / 2;
    f.segment<2>(2 * to) += force / 2;
  }
  return f;
}

Eigen::VectorXd supports(const Task& task, const Placed& points) {
  Eigen::VectorXd held(2 * points.places.cols());
  for (Eigen::Index k = 0; k < points.places.cols(); ++k) held.segment<2>(2 * k) = task.held(points.places.col(k));
  return held;
}

Answer answer(const Solid& solid, const Basis& basis, const Task& task, const Grid& grid, const Reference& reference) {
  const Placed points = placed(task, grid, basis.reach);
  const auto [u, p] = solution(solid, blocks(solid, points.body, basis), loads(task, points), supports(task, points));
  double alternating = 0, error = 0, exact = 0, own = 0;
  for (int r = 1; r < grid.rows; ++r)
    for (int c = 1; c < grid.columns; ++c) {
      const int k = r * (grid.columns + 1) + c, above = k + grid.columns + 1;
      const double known = reference.pressure(points.places.col(k));
      error += (p[k] - known) * (p[k] - known), exact += known * known, own += p[k] * p[k];
      const double quarter = (p[k] - p[k + 1] + p[above + 1] - p[above]) / 4;
      if (r + 1 < grid.rows && c + 1 < grid.columns) alternating += quarter * quarter;
    }
  return {u[2 * point_of(grid, task.watched) + 1], std::sqrt(error / exact), std::sqrt(alternating / own)};
}

}  // namespace galerkin_systems
