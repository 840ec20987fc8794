// Stiffness and patch tests of plane elasticity made of families.
#include "tests/verification/galerkin/plane.hpp"

#include <cmath>
#include <stdexcept>

namespace galerkin_systems {
namespace {

std::vector<Eigen::Index> unknowns(const Nodes& nodes) {
  std::vector<Eigen::Index> list;
  for (const int node : nodes) list.insert(list.end(), {2 * node, 2 * node + 1});
  return list;
}

const Sample& sample_at(const Family& f, int node) {
  for (const Sample& s : f.samples)
    if (f.nodes[std::size_t(s.at)] == node) return s;
  throw std::logic_error("Petrov-Galerkin needs families that hold each other's masters");
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

Eigen::MatrixXd plane_stiffness(const Solid& solid, const Body& b, const System& system) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 * b.points.cols(), 2 * b.points.cols());
  for (const Family& f : system) {
    const auto dofs = unknowns(f.nodes);
    K(dofs, dofs) += family_stiffness(solid, f);
  }
  return K;
}

Eigen::MatrixXd petrov_stiffness(const Eigen::Matrix3d& law, const Body& b, const System& trial, const System& test,
                                 Petrov kind) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 * b.points.cols(), 2 * b.points.cols());
  for (const Family& master : test)
    for (std::size_t i = 1; i < master.nodes.size(); ++i) {
      const int k = master.nodes[0], j = master.nodes[i];
      const Family& family = trial[std::size_t(kind == Petrov::first ? j : k)];
      const int at = kind == Petrov::first ? k : j;
      const Eigen::MatrixXd B = strain(sample_at(family, at).gradient);
      Eigen::Matrix2Xd bond_gradient(2, 2);
      bond_gradient << master.samples[0].gradient.col(Eigen::Index(i)),
          -master.samples[0].gradient.col(Eigen::Index(i));
      const double weight = b.areas[kind == Petrov::first ? k : j];
      K(unknowns({j, k}), unknowns(family.nodes)) += weight * strain(bond_gradient).transpose() * law * B;
    }
  return K;
}

System second_order_consistent(const Body& b, System test) {
  const Eigen::Index n = b.points.cols();
  for (int d = 0; d < 2; ++d) {
    // G_i += alpha + beta.X_i for i != k; Bode 5.25 gives beta = start - slope alpha, Bode 5.17 the system for alpha
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
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
        matrix(j, k) += b.areas[j] * factor;
        matrix(k, k) -= b.areas[j] * factor;
      }
    }
    const Eigen::VectorXd alpha = matrix.completeOrthogonalDecomposition().solve(target);
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

Norms patch_norms(const Solid& solid, const Body& b, const Eigen::MatrixXd& K, const Eigen::Matrix2Xd& normals,
                  const Field& field, const Eigen::Vector2d& b0) {
  Eigen::VectorXd exact(K.rows()), load(K.rows());
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < b.points.cols(); ++k) {
    const Eigen::Vector2d x = b.points.col(k);
    exact.segment<2>(2 * k) = field.value(x);
    load.segment<2>(2 * k) = solid.stress(field.gradient(x)) * normals.col(k) + b.areas[k] * b0;
    if (x.x() > 0 && x.x() < b.width && x.y() > 0) free.insert(free.end(), {2 * k, 2 * k + 1});
  }
  Eigen::VectorXd u = exact;
  u(free).setZero();
  const Eigen::VectorXd rest = (load - K * u)(free);
  const Eigen::VectorXd inner = Eigen::MatrixXd(K(free, free)).partialPivLu().solve(rest);
  u(free) = inner;
  const Eigen::VectorXd error = u - exact;
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
