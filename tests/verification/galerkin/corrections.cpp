// Variational consistency: correction functions and the one linear system of the correction factors.
#include <numeric>

#include "tests/verification/galerkin/systems.hpp"

namespace galerkin_systems {
namespace {

/// N^kki - delta_ki of a weighted least-squares fit whose basis holds a constant, in both components.
Eigen::Matrix2Xd shape_correction(const Body& b, const Nodes& nodes, bool quadratic) {
  const double scale = std::sqrt(b.areas[nodes[0]]);
  Eigen::MatrixXd p(quadratic ? 6 : 3, nodes.size());
  Eigen::VectorXd w(nodes.size());
  for (int i = 0; i < p.cols(); ++i) {
    const Eigen::Vector2d X = (b.points.col(nodes[std::size_t(i)]) - b.points.col(nodes[0])) / scale;
    p.col(i).head(3) << 1, X.x(), X.y();
    if (quadratic) p.col(i).tail(3) << X.x() * X.x(), X.x() * X.y(), X.y() * X.y();
    w[i] = i == 0 ? 0 : b.areas[nodes[std::size_t(i)]] / X.squaredNorm();
  }
  const Eigen::MatrixXd mass = p * w.asDiagonal() * p.transpose();
  const Eigen::VectorXd origin = Eigen::VectorXd::Unit(p.rows(), 0);
  Eigen::RowVectorXd N = mass.ldlt().solve(origin).transpose() * p * w.asDiagonal();
  N[0] -= 1;
  return N.replicate(2, 1);
}

Eigen::Matrix2d projector(const Sample& s) {
  return Eigen::Matrix2d::Identity() - s.bond * s.bond.transpose();
}

std::vector<Eigen::Index> all_points(const Body& b) {
  std::vector<Eigen::Index> points(std::size_t(b.points.cols()));
  std::iota(points.begin(), points.end(), 0);
  return points;
}

std::vector<Eigen::Index> interior_points(const Body& b) {
  auto points = all_points(b);
  for (const auto& [from, to] : b.outline) std::erase(points, from);
  return points;
}

}  // namespace

Eigen::Matrix2Xd nodal_normals(const Body& b, const System& system) {
  Eigen::Matrix2Xd sum = Eigen::Matrix2Xd::Zero(2, b.points.cols());
  for (const Family& f : system)
    for (const Sample& s : f.samples)
      for (std::size_t i = 0; i < f.nodes.size(); ++i)
        sum.col(f.nodes[i]) += s.weight * s.gradient.col(Eigen::Index(i));
  return sum;
}

Eigen::Matrix2Xd constant_correction(const Body&, const Nodes& nodes) {
  Eigen::Matrix2Xd phi = Eigen::Matrix2Xd::Ones(2, nodes.size());
  phi.col(0).setConstant(1 - double(nodes.size()));
  return phi;
}

Eigen::Matrix2Xd second_derivative_correction(const Body& b, const Nodes& nodes) {
  const auto d = quadratic_derivatives(b, nodes);
  Eigen::Matrix2Xd phi(2, nodes.size());
  phi << d.row(2), d.row(4);
  return b.areas[nodes[0]] * phi;
}

Eigen::Matrix2Xd linear_correction(const Body& b, const Nodes& nodes) {
  return shape_correction(b, nodes, false);
}

Eigen::Matrix2Xd quadratic_correction(const Body& b, const Nodes& nodes) {
  return shape_correction(b, nodes, true);
}

System variationally_consistent(const Body& b, System system, const Correction& correction, Normals normals) {
  const auto n = Eigen::Index(system.size());
  std::vector<Eigen::Matrix2Xd> phi;
  std::array<Eigen::MatrixXd, 2> matrix{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  for (Eigen::Index k = 0; k < n; ++k) {
    const Nodes& nodes = system[std::size_t(k)].nodes;
    phi.push_back(correction(b, nodes));
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t d = 0; d < 2; ++d) matrix[d](nodes[i], k) = phi.back()(Eigen::Index(d), Eigen::Index(i));
  }
  // beta_k = sum w (I - n n) alpha_k decouples the components
  const Eigen::Matrix2Xd error = nodal_normals(b, system) - b.normals;
  const auto open = normals == Normals::given ? all_points(b) : interior_points(b);
  Eigen::Matrix2Xd beta = Eigen::Matrix2Xd::Zero(2, n);
  for (int d = 0; d < 2; ++d) {
    const Eigen::MatrixXd part = matrix[std::size_t(d)](open, open);
    const Eigen::VectorXd target = -error.row(d).transpose()(open);
    const Eigen::VectorXd solution = part.completeOrthogonalDecomposition().solve(target);
    for (std::size_t i = 0; i < open.size(); ++i) beta(d, open[i]) = solution[Eigen::Index(i)];
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    Family& f = system[std::size_t(k)];
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    for (const Sample& s : f.samples) sum += s.weight * projector(s);
    const Eigen::Vector2d alpha = sum.inverse() * beta.col(k);
    for (Sample& s : f.samples) s.gradient += projector(s) * alpha.asDiagonal() * phi[std::size_t(k)];
  }
  return system;
}

double consistency_residual(const Body& b, const System& system) {
  return (nodal_normals(b, system) - b.normals).cwiseAbs().maxCoeff();
}

}  // namespace galerkin_systems
