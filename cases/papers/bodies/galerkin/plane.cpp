// Stiffness and patch tests of plane elasticity made of families.
#include "cases/papers/bodies/galerkin/plane.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace galerkin_systems {
namespace {

/// The test gradient of a family's master for another node.
Eigen::Vector2d gradient_at(const Family& family, int node) {
  const auto found = std::ranges::find(family.nodes, node);
  if (found == family.nodes.end())
    throw std::logic_error("Petrov-Galerkin needs families that hold each other's masters");
  return family.samples[0].gradient.col(found - family.nodes.begin());
}

/// The bonds' area-weighted moments of a family about its master.
struct Moments {
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
};

Eigen::Vector2d bond(const Body& b, const Nodes& nodes, std::size_t i) {
  return b.points.col(nodes[i]) - b.points.col(nodes[0]);
}

Moments moments(const Body& b, const Nodes& nodes) {
  Moments m;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const Eigen::Vector2d X = bond(b, nodes, i);
    m.first += b.areas[nodes[i]] * X;
    m.second += b.areas[nodes[i]] * X * X.transpose();
  }
  return m;
}

}  // namespace

std::vector<int> unknowns(const Nodes& nodes) {
  std::vector<int> list;
  for (const int node : nodes) list.insert(list.end(), {2 * node, 2 * node + 1});
  return list;
}

Eigen::MatrixXd strain(const Eigen::Matrix2Xd& gradient) {
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(3, 2 * gradient.cols());
  for (Eigen::Index i = 0; i < gradient.cols(); ++i) {
    B(0, 2 * i) = B(2, 2 * i + 1) = gradient(0, i);
    B(1, 2 * i + 1) = B(2, 2 * i) = gradient(1, i);
  }
  return B;
}

Eigen::Matrix3d law(const Solid& s) {
  const double l = s.lambda(), m = s.mu();
  return Eigen::Matrix3d{{l + 2 * m, l, 0}, {l, l + 2 * m, 0}, {0, 0, m}};
}

Eigen::Matrix3d isochoric_law(const Solid& s) {
  const double m = s.mu();
  return Eigen::Matrix3d{{4 * m / 3, -2 * m / 3, 0}, {-2 * m / 3, 4 * m / 3, 0}, {0, 0, m}};
}

Eigen::MatrixXd family_stiffness(const Solid& solid, const Family& family) {
  const auto n = Eigen::Index(2 * family.nodes.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (const Sample& s : family.samples) {
    const Eigen::MatrixXd B = strain(s.gradient);
    K += s.weight * B.transpose() * law(solid) * B;
  }
  return K;
}

void add_block(Triplets& list, const Eigen::MatrixXd& values, const std::vector<int>& rows,
               const std::vector<int>& columns) {
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (std::size_t i = 0; i < rows.size(); ++i)
      list.emplace_back(rows[i], columns[j], values(Eigen::Index(i), Eigen::Index(j)));
}

Sparse sparse(const Triplets& entries, Eigen::Index rows, Eigen::Index columns) {
  Sparse matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Sparse plane_stiffness(const Solid& solid, const Body& b, const System& system) {
  Triplets entries;
  for (const Family& f : system) {
    const auto dofs = unknowns(f.nodes);
    add_block(entries, family_stiffness(solid, f), dofs, dofs);
  }
  return sparse(entries, 2 * b.points.cols(), 2 * b.points.cols());
}

Sparse petrov_stiffness(const Eigen::Matrix3d& law, const Body& b, const System& trial, const System& test,
                        Petrov kind) {
  Triplets entries;
  for (const Family& f : trial) {
    const auto dofs = unknowns(f.nodes);
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(Eigen::Index(dofs.size()), Eigen::Index(dofs.size()));
    for (const Sample& s : f.samples) {
      if (s.at == 0) continue;
      const int own = f.nodes[0], other = f.nodes[std::size_t(s.at)];
      const bool first = kind == Petrov::first;
      const Family& master = test[std::size_t(first ? other : own)];
      const Eigen::Matrix<double, 3, 2> bond = strain(gradient_at(master, first ? own : other));
      const Eigen::Matrix2Xd force = b.areas[other] * bond.transpose() * law * strain(s.gradient);
      K.middleRows<2>(first ? 0 : 2 * s.at) += force;
      K.middleRows<2>(first ? 2 * s.at : 0) -= force;
    }
    add_block(entries, K, dofs, dofs);
  }
  return sparse(entries, 2 * b.points.cols(), 2 * b.points.cols());
}

System second_order_consistent(const Body& b, System test) {
  const Eigen::Index n = b.points.cols();
  for (int d = 0; d < 2; ++d) {
    // G_i += alpha + beta.X_i for i != k; Bode 5.25 gives beta = start - slope alpha, Bode 5.17 the system for alpha
    Triplets entries;
    Eigen::VectorXd target = b.normals.row(d);
    Eigen::Matrix2Xd start(2, n), slope(2, n);
    for (const Family& f : test) {
      const int k = f.nodes[0];
      auto G = f.samples[0].gradient.row(d);
      const Moments m = moments(b, f.nodes);
      Eigen::Vector2d missing = b.areas[k] * Eigen::Vector2d::Unit(d);
      for (std::size_t i = 1; i < f.nodes.size(); ++i)
        missing -= b.areas[f.nodes[i]] * G[Eigen::Index(i)] * bond(b, f.nodes, i);
      start.col(k) = m.second.inverse() * missing;
      slope.col(k) = m.second.inverse() * m.first;
      for (std::size_t i = 1; i < f.nodes.size(); ++i) {
        const int j = f.nodes[i];
        const Eigen::Vector2d X = bond(b, f.nodes, i);
        const double known = G[Eigen::Index(i)] + start.col(k).dot(X), factor = 1 - slope.col(k).dot(X);
        target[j] -= b.areas[j] * known;
        target[k] += b.areas[j] * known;
        entries.emplace_back(j, k, b.areas[j] * factor);
        entries.emplace_back(k, k, -b.areas[j] * factor);
      }
    }
    const Eigen::VectorXd alpha = least_norm(sparse(entries, n, n), target);
    for (Family& f : test) {
      const int k = f.nodes[0];
      const Eigen::Vector2d beta = start.col(k) - slope.col(k) * alpha[k];
      auto G = f.samples[0].gradient.row(d);
      for (std::size_t i = 1; i < f.nodes.size(); ++i) G[Eigen::Index(i)] += alpha[k] + beta.dot(bond(b, f.nodes, i));
      G[0] = -G.tail(G.size() - 1).sum();
    }
  }
  return test;
}

Field linear_field() {
  const Eigen::Matrix2d H{{0.1, 0.3}, {0.2, 0.4}};
  return {[H](const Eigen::Vector2d& x) { return Eigen::Vector2d(H * x); }, [H](const Eigen::Vector2d&) { return H; }};
}

Field quadratic_field() {
  const auto value = [](const Eigen::Vector2d& moved) {
    const double x = moved.x() - 1, y = moved.y() - 1;
    return Eigen::Vector2d(0.12 * x + 0.14 * y + 0.16 * x * x + 0.18 * x * y + 0.2 * y * y,
                           0.11 * x + 0.13 * y + 0.15 * x * x + 0.1 * x * y + 0.21 * y * y);
  };
  const auto gradient = [](const Eigen::Vector2d& moved) {
    const double x = moved.x() - 1, y = moved.y() - 1;
    return Eigen::Matrix2d{{0.12 + 0.32 * x + 0.18 * y, 0.14 + 0.18 * x + 0.4 * y},
                           {0.11 + 0.3 * x + 0.1 * y, 0.13 + 0.1 * x + 0.42 * y}};
  };
  return {value, gradient};
}

Eigen::Vector2d quadratic_body_force(const Solid& solid) {
  const double l = solid.lambda(), m = solid.mu();
  return {-(0.42 * l + 1.14 * m), -(0.6 * l + 1.32 * m)};
}

Field manufactured_field() {
  constexpr double q = std::numbers::pi / 2;
  const auto value = [](const Eigen::Vector2d& moved) {
    const double x = q * (moved.x() - 1), y = q * (moved.y() - 1);
    return Eigen::Vector2d(std::sin(x) * std::cos(y), std::cos(x) * std::sin(y));
  };
  const auto gradient = [](const Eigen::Vector2d& moved) {
    const double x = q * (moved.x() - 1), y = q * (moved.y() - 1);
    const double cc = q * std::cos(x) * std::cos(y), ss = q * std::sin(x) * std::sin(y);
    return Eigen::Matrix2d{{cc, -ss}, {-ss, cc}};
  };
  return {value, gradient};
}

Eigen::Vector2d manufactured_body_force(const Solid& solid, const Eigen::Vector2d& x) {
  const double q = std::numbers::pi / 2;
  return 2 * q * q * (solid.lambda() + 2 * solid.mu()) * manufactured_field().value(x);
}

Norms field_norms(const Body& b, const System& read, const Eigen::VectorXd& u, const Field& field) {
  Norms norms{0, 0};
  for (Eigen::Index k = 0; k < b.points.cols(); ++k) {
    const Family& f = read[std::size_t(k)];
    Eigen::Matrix2d error = -field.gradient(b.points.col(k));
    for (std::size_t i = 0; i < f.nodes.size(); ++i)
      error += u.segment<2>(2 * f.nodes[i]) * f.samples[0].gradient.col(Eigen::Index(i)).transpose();
    norms.L2 += b.areas[k] * (u.segment<2>(2 * k) - field.value(b.points.col(k))).squaredNorm();
    norms.H1 += b.areas[k] * error.squaredNorm();
  }
  return {std::sqrt(norms.L2), std::sqrt(norms.H1)};
}

Eigen::VectorXd solved_by_lu(const Sparse& K, const Eigen::VectorXd& f, const Eigen::VectorXd& prescribed) {
  Eigen::VectorXd u = prescribed.unaryExpr([](double v) { return std::isnan(v) ? 0 : v; });
  const Eigen::VectorXd rest = f - K * u;
  Triplets entries;
  Eigen::VectorXd right = rest;
  const auto open = [&](Eigen::Index i) { return std::isnan(prescribed[i]); };
  for (Eigen::Index j = 0; j < K.outerSize(); ++j) {
    if (!open(j)) entries.emplace_back(int(j), int(j), 1), right[j] = 0;
    for (Sparse::InnerIterator it(K, j); it; ++it)
      if (open(it.row()) && open(j)) entries.emplace_back(int(it.row()), int(j), it.value());
  }
  const Sparse matrix = sparse(entries, K.rows(), K.cols());
  const Eigen::SparseLU<Sparse, Eigen::NaturalOrdering<int>> factor(matrix);  // rows of a lattice: a narrow band
  if (factor.info() != Eigen::Success) throw std::runtime_error("the stiffness has no factor");
  return u + Eigen::VectorXd(factor.solve(right));
}

Norms patch_norms(const Solid& solid, const Body& b, const Sparse& K, const Eigen::Matrix2Xd& normals,
                  const Field& field, const Eigen::Vector2d& b0) {
  Eigen::VectorXd exact(K.rows()), load(K.rows()), prescribed = nothing_prescribed(K.rows());
  for (Eigen::Index k = 0; k < b.points.cols(); ++k) {
    const Eigen::Vector2d x = b.points.col(k);
    exact.segment<2>(2 * k) = field.value(x);
    load.segment<2>(2 * k) = solid.stress(field.gradient(x)) * normals.col(k) + b.areas[k] * b0;
    const bool inside = x.x() > 0 && x.x() < b.width && x.y() > 0;
    if (!inside) prescribed.segment<2>(2 * k) = exact.segment<2>(2 * k);
  }
  const Eigen::VectorXd error = solved_by_lu(K, load, prescribed) - exact;
  Norms norms{0, 0};
  for (const Family& f : linear_static(b)) {
    Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
    for (std::size_t i = 0; i < f.nodes.size(); ++i)
      H += error.segment<2>(2 * f.nodes[i]) * f.samples[0].gradient.col(Eigen::Index(i)).transpose();
    norms.L2 += b.areas[f.nodes[0]] * error.segment<2>(2 * f.nodes[0]).squaredNorm();
    norms.H1 += b.areas[f.nodes[0]] * H.squaredNorm();
  }
  return {std::sqrt(norms.L2), std::sqrt(norms.H1)};
}

}  // namespace galerkin_systems
