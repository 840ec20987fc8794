// Stiffness, loads and solutions of a Mindlin plate made of families.
#include "tests/verification/galerkin/plate.hpp"
#include "tests/dense.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

namespace galerkin_systems {
namespace {

using Rows = Eigen::MatrixXd;

/// kappa_xx, kappa_yy, 2 kappa_xy of a sample from its family's degrees of freedom.
Rows curvature(const Sample& s) {
  Rows B = Rows::Zero(3, 3 * s.gradient.cols());
  for (Eigen::Index i = 0; i < s.gradient.cols(); ++i) {
    B(0, 3 * i + 1) = B(2, 3 * i + 2) = s.gradient(0, i);
    B(1, 3 * i + 2) = B(2, 3 * i + 1) = s.gradient(1, i);
  }
  return B;
}

/// gamma of a sample; X: bonds from the master.
Rows transverse_shear(const Sample& s, const Eigen::Matrix2Xd& X, bool direct) {
  Rows B = Rows::Zero(2, 3 * s.gradient.cols());
  for (Eigen::Index i = 0; i < s.gradient.cols(); ++i) {
    B.col(3 * i) = s.gradient.col(i);
    if (!direct) {
      const Eigen::Matrix2d half = s.gradient.col(i) * X.col(i).transpose() / 2;
      B.middleCols(3 * i + 1, 2) -= half;
      B.middleCols(1, 2) -= half;
    }
  }
  if (direct) B.middleCols(3 * s.at + 1, 2) -= Eigen::Matrix2d::Identity();
  return B;
}

/// gamma of all samples of a family, two rows each.
Rows transverse_shear(const Family& f, const Eigen::Matrix2Xd& X, Shear shear) {
  Rows all(2 * Eigen::Index(f.samples.size()), 3 * X.cols()), mean = Rows::Zero(2, all.cols());
  double sum = 0;
  for (std::size_t i = 0; i < f.samples.size(); ++i) {
    const Sample& s = f.samples[i];
    const Rows own = transverse_shear(s, X, shear == Shear::direct || shear == Shear::assumed_direct);
    all.middleRows<2>(2 * Eigen::Index(i)) = own;
    mean += s.weight * own;
    sum += s.weight;
  }
  mean /= sum;
  if (shear == Shear::bond || shear == Shear::direct) return all;
  for (std::size_t i = 0; i < f.samples.size(); ++i) {
    const Eigen::Vector2d n = shear == Shear::assumed_along ? f.samples[i].bond : Eigen::Vector2d::Zero();
    auto own = all.middleRows<2>(2 * Eigen::Index(i));
    own = mean + n * (n.transpose() * (own - mean)).eval();
  }
  return all;
}

Eigen::Matrix3d bending_law(const Plate& p) {
  Eigen::Matrix3d C;
  C << 1, p.poisson, 0, p.poisson, 1, 0, 0, 0, (1 - p.poisson) / 2;
  return p.D() * C;
}

}  // namespace

Sparse stiffness(const Plate& plate, const System& system, const Body& b, Shear shear) {
  const Eigen::Matrix3d law = bending_law(plate);
  std::vector<Eigen::Triplet<double>> entries;
  for (const Family& f : system) {
    Eigen::Matrix2Xd X(2, f.nodes.size());
    for (std::size_t i = 0; i < f.nodes.size(); ++i)
      X.col(Eigen::Index(i)) = b.points.col(f.nodes[i]) - b.points.col(f.nodes[0]);
    Rows strain(5 * Eigen::Index(f.samples.size()), 3 * X.cols()), stress = strain;
    const Rows gamma = transverse_shear(f, X, shear);
    for (Eigen::Index i = 0; i < Eigen::Index(f.samples.size()); ++i) {
      const Sample& s = f.samples[std::size_t(i)];
      strain.middleRows<3>(5 * i) = curvature(s);
      strain.middleRows<2>(5 * i + 3) = gamma.middleRows<2>(2 * i);
      stress.middleRows<3>(5 * i) = s.weight * law * strain.middleRows<3>(5 * i);
      stress.middleRows<2>(5 * i + 3) = s.weight * s.shear * plate.kG() * strain.middleRows<2>(5 * i + 3);
    }
    const Eigen::MatrixXd local = strain.transpose() * stress;
    for (int i = 0; i < local.rows(); ++i)
      for (int j = 0; j < local.cols(); ++j)
        entries.emplace_back(3 * f.nodes[std::size_t(i / 3)] + i % 3, 3 * f.nodes[std::size_t(j / 3)] + j % 3,
                             local(i, j));
  }
  Sparse K(3 * b.points.cols(), 3 * b.points.cols());
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

Eigen::VectorXd lumped_mass(const Plate& p, const Body& b) {
  const double h = p.thickness;
  Eigen::VectorXd mass(3 * b.areas.size());
  for (Eigen::Index k = 0; k < b.areas.size(); ++k)
    mass.segment<3>(3 * k) = p.density * h * b.areas[k] * Eigen::Vector3d(1, h * h / 12, h * h / 12);
  return mass;
}

Eigen::VectorXd patch_load(const Body& b, const Eigen::Matrix2d& M, const Eigen::Vector2d& Q) {
  Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * b.points.cols());
  for (Eigen::Index k = 0; k < b.points.cols(); ++k) f.segment<2>(3 * k + 1) += M * b.normals.col(k) - b.areas[k] * Q;
  for (const auto& [from, to] : b.outline) {
    const Eigen::Vector2d edge = b.points.col(to) - b.points.col(from);
    const double force = Q.x() * edge.y() - Q.y() * edge.x();
    f[3 * from] += force / 2;
    f[3 * to] += force / 2;
    f.segment<2>(3 * from + 1) += force / 12 * edge;
    f.segment<2>(3 * to + 1) -= force / 12 * edge;
  }
  return f;
}

Eigen::VectorXd all_frequencies(const Sparse& K, const Eigen::VectorXd& mass) {
  const Eigen::VectorXd scale = mass.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd A = scale.asDiagonal() * Eigen::MatrixXd(K) * scale.asDiagonal();
  return dense::eigenvalues(A);
}

double centre_deflection(const Body& b, const Sparse& K, Held held) {
  Eigen::VectorXd pressure = Eigen::VectorXd::Zero(K.rows()), prescribed = nothing_prescribed(K.rows());
  for (Eigen::Index k = 0; k < b.areas.size(); ++k) pressure[3 * k] = b.areas[k];
  for (const auto& [from, to] : b.outline) {
    const Eigen::Vector2d edge = b.points.col(to) - b.points.col(from);
    for (const int k : {from, to}) {
      prescribed[3 * k] = 0;
      if (held == Held::clamped || edge.y() == 0) prescribed[3 * k + 1] = 0;
      if (held == Held::clamped || edge.x() == 0) prescribed[3 * k + 2] = 0;
    }
  }
  return solved(K, pressure, prescribed)[3 * (b.areas.size() / 2)];
}

Eigen::VectorXd lowest_frequencies(const Sparse& K, const Eigen::VectorXd& mass, int count) {
  const Eigen::VectorXd root = mass.cwiseSqrt();
  const Sparse A = root.cwiseInverse().asDiagonal() * K * root.cwiseInverse().asDiagonal();
  const double shift = 1e-7 * A.diagonal().maxCoeff();
  Sparse shifted = A;
  for (Eigen::Index i = 0; i < A.rows(); ++i) shifted.coeffRef(i, i) += shift;
  const Eigen::SimplicialLDLT<Sparse> factor(shifted);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::MatrixXd V = Eigen::MatrixXd::NullaryExpr(A.rows(), 2 * count, [&] { return uniform(random); });
  Eigen::VectorXd values = Eigen::VectorXd::Zero(V.cols()), last = values;
  for (int iteration = 0; iteration < 60; ++iteration) {
    V = Eigen::HouseholderQR<Eigen::MatrixXd>(V).householderQ() * Eigen::MatrixXd::Identity(V.rows(), V.cols());
    const Eigen::MatrixXd AV = A * V;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> projected(V.transpose() * AV);
    last = std::exchange(values, projected.eigenvalues());
    if ((values - last).head(count).cwiseAbs().maxCoeff() < 1e-8 * values[count - 1]) break;
    V = factor.solve(V * projected.eigenvectors());
  }
  return values.head(count);
}

}  // namespace galerkin_systems
