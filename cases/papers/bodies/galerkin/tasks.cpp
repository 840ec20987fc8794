// Bodies, loads and answers of plane problems by points; Q2/P-1 elements: nine nodes, three pressures condensed in each
// element.
#include "cases/papers/bodies/galerkin/tasks.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

namespace galerkin_systems {
namespace {

using Eigen::Vector2d;

constexpr double open = std::numeric_limits<double>::quiet_NaN();

Vector2d clamped_left(const Vector2d& s) {
  return s.x() == 0 ? Vector2d(0, 0) : Vector2d(open, open);
}

/// Distance of the square's outline from the hole's centre along a ray.
double to_square(const Vector2d& ray) {
  return 4 / std::max(ray.x(), ray.y());
}

/// Cells at the hole are half as wide as on average.
double closer_to_hole(double s) {
  return s * (1 + s) / 2;
}

int point_of(const Grid& g, const Vector2d& s) {
  return int(std::lround(s.y() * g.rows)) * (g.columns + 1) + int(std::lround(s.x() * g.columns));
}

using Matrix9 = Eigen::Matrix<double, 2, 9>;

/// Quadratic Lagrange functions on [0, 1], nodes at 0, 1/2, 1: values and slopes.
std::array<Eigen::Vector3d, 2> quadratics(double t) {
  return {Eigen::Vector3d((2 * t - 1) * (t - 1), 4 * t * (1 - t), t * (2 * t - 1)),
          Eigen::Vector3d(4 * t - 3, 4 - 8 * t, 4 * t - 1)};
}

struct Element {
  std::array<int, 9> nodes;
  Matrix9 x;
  Vector2d middle;
};

/// Number of a node in its element, by column and row.
int node_of(int a, int b) {
  return b * 3 + a;
}

struct At {
  Matrix9 gradient;
  double area;
  Vector2d x;
};

At at(const Element& e, const Vector2d& t) {
  const auto [fx, dx] = quadratics(t.x());
  const auto [fy, dy] = quadratics(t.y());
  Matrix9 slope;
  Eigen::Matrix<double, 9, 1> value;
  for (int b = 0; b < 3; ++b)
    for (int a = 0; a < 3; ++a) {
      slope.col(node_of(a, b)) << dx[a] * fy[b], fx[a] * dy[b];
      value[node_of(a, b)] = fx[a] * fy[b];
    }
  const Eigen::Matrix2d jacobian = slope * e.x.transpose();
  return {jacobian.inverse() * slope, jacobian.determinant(), e.x * value};
}

struct Condensed {
  Eigen::MatrixXd stiffness;              ///< 18 x 18
  Eigen::Matrix<double, 3, 18> pressure;  ///< of 1, x - middle
};

Condensed condensed(const Solid& solid, const Element& e) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(18, 18);
  Eigen::Matrix<double, 3, 18> divergence = Eigen::Matrix<double, 3, 18>::Zero();
  Eigen::Matrix3d mass = Eigen::Matrix3d::Zero();
  const std::array<double, 3> places{0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)},
      weights{5. / 18, 4. / 9, 5. / 18};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const At g = at(e, {places[i], places[j]});
      const double weight = weights[i] * weights[j] * g.area;
      const Eigen::Vector3d q(1, g.x.x() - e.middle.x(), g.x.y() - e.middle.y());
      const Eigen::MatrixXd B = strain(g.gradient);
      K += weight * B.transpose() * isochoric_law(solid) * B;
      divergence += weight * q * (B.row(0) + B.row(1));
      mass += weight * q * q.transpose();
    }
  const Eigen::Matrix<double, 3, 18> pressure = solid.bulk() * mass.inverse() * divergence;
  return {K + divergence.transpose() * pressure, pressure};
}

Element element(const Task& task, const Grid& g, int column, int row) {
  Element e;
  for (int b = 0; b < 3; ++b)
    for (int a = 0; a < 3; ++a) {
      const int x = 2 * column + a, y = 2 * row + b;
      e.nodes[std::size_t(node_of(a, b))] = y * (2 * g.columns + 1) + x;
      e.x.col(node_of(a, b)) = task.map({x / (2.0 * g.columns), y / (2.0 * g.rows)});
    }
  e.middle = e.x.col(4);
  return e;
}

/// A constant traction on a quadratic edge: 1/6, 2/3, 1/6.
void load_edge(Eigen::VectorXd& f, const Task& task, const Element& e, const Grid& g, const std::array<int, 3>& edge) {
  const int nodes_across = 2 * g.columns + 1, node = e.nodes[std::size_t(edge[1])];
  const Vector2d s(node % nodes_across / (2.0 * g.columns), node / nodes_across / (2.0 * g.rows));
  const Vector2d force = (e.x.col(edge[2]) - e.x.col(edge[0])).norm() * task.traction(s);
  const bool border = s.x() == 0 || s.x() == 1 || s.y() == 0 || s.y() == 1;
  for (std::size_t i = 0; border && i < 3; ++i)
    f.segment<2>(2 * e.nodes[std::size_t(edge[i])]) += force * (i == 1 ? 4 : 1) / 6;
}

std::vector<int> element_unknowns(const Element& e) {
  std::vector<int> list;
  for (const int node : e.nodes) list.insert(list.end(), {2 * node, 2 * node + 1});
  return list;
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

Sparse coupled(const Solid& solid, const Body& whole, const std::function<bool(const Vector2d&)>& in_elements,
               const std::function<Sparse(const Body&)>& stiffness_of_families) {
  const Part elements = part(whole, in_elements);
  const Part families = part(whole, [&](const Vector2d& x) { return !in_elements(x); });
  const Sparse own = stiffness_of_families(families.body);
  const auto dofs = unknowns(families.names);
  Triplets entries;
  for (int j = 0; j < own.outerSize(); ++j)
    for (Sparse::InnerIterator it(own, j); it; ++it)
      entries.emplace_back(dofs[std::size_t(it.row())], dofs[std::size_t(j)], it.value());
  const Eigen::Index n = 2 * whole.points.cols();
  return plane_stiffness(solid, whole, renamed(bilinear(elements.body), elements.names)) + sparse(entries, n, n);
}

Task plate_with_hole() {
  const auto map = [](const Vector2d& s) {
    const double angle = s.y() * std::numbers::pi / 2;
    const Vector2d ray(std::cos(angle), std::sin(angle));
    return Vector2d((1 + (to_square(ray) - 1) * closer_to_hole(s.x())) * ray);
  };
  const auto held = [](const Vector2d& s) { return Vector2d(s.y() == 1 ? 0 : open, s.y() == 0 ? 0 : open); };
  const auto traction = [map](const Vector2d& s) {
    const Vector2d normal = s.y() < 0.5 ? Vector2d(1, 0) : Vector2d(0, 1);
    return s.x() == 1 ? Vector2d(hole_stress(map(s)) * normal) : Vector2d(0, 0);
  };
  return {map, held, traction, {0, 1}};
}

bool beyond_hole(const Vector2d& x) {
  const double r = x.norm();
  return (r - 1) / (to_square(x / r) - 1) > closer_to_hole(0.5);
}

Eigen::Matrix2d hole_stress(const Vector2d& x) {
  const double angle = std::atan2(x.y(), x.x()), r2 = 1 / x.squaredNorm(), r4 = r2 * r2;
  const double c2 = std::cos(2 * angle), c4 = std::cos(4 * angle), s2 = std::sin(2 * angle), s4 = std::sin(4 * angle);
  const double xx = 1 - r2 * (1.5 * c2 + c4) + 1.5 * r4 * c4, yy = -r2 * (0.5 * c2 - c4) - 1.5 * r4 * c4,
               xy = -r2 * (0.5 * s2 + s4) + 1.5 * r4 * s4;
  return Eigen::Matrix2d{{xx, xy}, {xy, yy}};
}

Vector2d hole_displacement(const Solid& solid, const Vector2d& x) {
  const double angle = std::atan2(x.y(), x.x()), r = x.norm(), kappa = 3 - 4 * solid.poisson;
  const double c = std::cos(angle), s = std::sin(angle), c3 = std::cos(3 * angle), s3 = std::sin(3 * angle);
  const double ux = r * (kappa + 1) * c + 2 / r * ((1 + kappa) * c + c3) - 2 / (r * r * r) * c3,
               uy = r * (kappa - 3) * s + 2 / r * ((1 - kappa) * s + s3) - 2 / (r * r * r) * s3;
  return Vector2d(ux, uy) / (8 * solid.mu());
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

Reference quadratic_elements(const Solid& solid, const Task& task, const Grid& g) {
  const int across = 2 * g.columns + 1, nodes = across * (2 * g.rows + 1);
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd f = Eigen::VectorXd::Zero(2 * nodes), held(2 * nodes);
  for (int k = 0; k < nodes; ++k)
    held.segment<2>(2 * k) = task.held({k % across / (2.0 * g.columns), k / across / (2.0 * g.rows)});
  for (int r = 0; r < g.rows; ++r)
    for (int c = 0; c < g.columns; ++c) {
      const Element e = element(task, g, c, r);
      const auto dofs = element_unknowns(e);
      const Eigen::MatrixXd K = condensed(solid, e).stiffness;
      for (int i = 0; i < 18; ++i)
        for (int j = 0; j < 18; ++j) entries.emplace_back(dofs[std::size_t(i)], dofs[std::size_t(j)], K(i, j));
      for (const auto& edge : {std::array{0, 1, 2}, std::array{6, 7, 8}, std::array{0, 3, 6}, std::array{2, 5, 8}})
        load_edge(f, task, e, g, edge);
    }
  Sparse K(2 * nodes, 2 * nodes);
  K.setFromTriplets(entries.begin(), entries.end());
  const auto u = std::make_shared<const Eigen::VectorXd>(solved(K, f, held));
  const auto pressure = [=](const Vector2d& s) {
    const int c = std::min(int(s.x() * g.columns), g.columns - 1), r = std::min(int(s.y() * g.rows), g.rows - 1);
    const Element e = element(task, g, c, r);
    const Vector2d x = task.map(s) - e.middle;
    return Eigen::RowVector3d(1, x.x(), x.y()).dot(condensed(solid, e).pressure * (*u)(element_unknowns(e)));
  };
  const int watched =
      int(std::lround(task.watched.y() * 2 * g.rows)) * across + int(std::lround(task.watched.x() * 2 * g.columns));
  return {(*u)[2 * watched + 1], pressure};
}

}  // namespace galerkin_systems
