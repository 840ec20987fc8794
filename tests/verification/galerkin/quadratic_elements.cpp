// Q2/P-1 elements: nine nodes, three pressures condensed in each element.
#include <array>
#include <cmath>
#include <memory>

#include "tests/verification/galerkin/plate.hpp"
#include "tests/verification/galerkin/tasks.hpp"

namespace galerkin_systems {
namespace {

using Eigen::Vector2d;
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
      slope.col(3 * b + a) << dx[a] * fy[b], fx[a] * dy[b];
      value[3 * b + a] = fx[a] * fy[b];
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
      e.nodes[std::size_t(3 * b + a)] = y * (2 * g.columns + 1) + x;
      e.x.col(3 * b + a) = task.map({x / (2.0 * g.columns), y / (2.0 * g.rows)});
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

std::vector<int> unknowns(const Element& e) {
  std::vector<int> list;
  for (const int node : e.nodes) list.insert(list.end(), {2 * node, 2 * node + 1});
  return list;
}

}  // namespace

Reference quadratic_elements(const Solid& solid, const Task& task, const Grid& g) {
  const int across = 2 * g.columns + 1, nodes = across * (2 * g.rows + 1);
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd f = Eigen::VectorXd::Zero(2 * nodes), held(2 * nodes);
  for (int k = 0; k < nodes; ++k)
    held.segment<2>(2 * k) = task.held({k % across / (2.0 * g.columns), k / across / (2.0 * g.rows)});
  for (int r = 0; r < g.rows; ++r)
    for (int c = 0; c < g.columns; ++c) {
      const Element e = element(task, g, c, r);
      const auto dofs = unknowns(e);
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
    return Eigen::RowVector3d(1, x.x(), x.y()).dot(condensed(solid, e).pressure * (*u)(unknowns(e)));
  };
  const int watched =
      int(std::lround(task.watched.y() * 2 * g.rows)) * across + int(std::lround(task.watched.x() * 2 * g.columns));
  return {(*u)[2 * watched + 1], pressure};
}

}  // namespace galerkin_systems
