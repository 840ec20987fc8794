// The formulations' gradients and their integration.
#include <algorithm>
#include <numbers>

#include "tests/verification/galerkin/systems.hpp"

namespace galerkin_systems {
namespace {

int position(const Nodes& nodes, int node) {
  return int(std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
}

/// Node coordinates relative to one of the list.
Eigen::Matrix2Xd bonds(const Body& b, const Nodes& nodes, int at) {
  Eigen::Matrix2Xd X(2, nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) X.col(Eigen::Index(i)) = b.points.col(nodes[i]);
  return X.colwise() - Eigen::Vector2d(X.col(at));
}

/// omega V_i = V_i / r^2, zero at the reference point, Bode 5.41, 5.42.
Eigen::VectorXd weights(const Body& b, const Nodes& nodes, int at) {
  const Eigen::Matrix2Xd X = bonds(b, nodes, at);
  Eigen::VectorXd w(nodes.size());
  for (int i = 0; i < w.size(); ++i) w[i] = i == at ? 0 : b.areas[nodes[std::size_t(i)]] / X.col(i).squaredNorm();
  return w;
}

/// Weighted least squares of a basis without a constant: its coefficients per node, those of `at` closing the sum.
Eigen::MatrixXd taylor_coefficients(const Eigen::MatrixXd& basis, const Eigen::VectorXd& w, int at) {
  Eigen::MatrixXd coefficients = (basis * w.asDiagonal() * basis.transpose()).ldlt().solve(basis * w.asDiagonal());
  coefficients.col(at).setZero();
  coefficients.col(at) = -coefficients.rowwise().sum();
  return coefficients;
}

/// x, y, x^2/2, xy, y^2/2 of each bond of the master, lengths in units of `scale`.
Eigen::MatrixXd quadratic_basis(const Eigen::Matrix2Xd& X, double scale) {
  Eigen::MatrixXd p(5, X.cols());
  p.topRows(2) = X / scale;
  p.row(2) = p.row(0).cwiseAbs2() / 2;
  p.row(3) = p.row(0).cwiseProduct(p.row(1));
  p.row(4) = p.row(1).cwiseAbs2() / 2;
  return p;
}

/// Bode 5.55: the gradient's part along the bond to node `at` is the bond's own difference quotient.
Sample bond_conforming(Sample s, const Eigen::Vector2d& X) {
  s.bond = X.normalized();
  s.gradient -= s.bond * (s.bond.transpose() * s.gradient);
  s.gradient.col(s.at) += X / X.squaredNorm();
  s.gradient.col(0) -= X / X.squaredNorm();
  return s;
}

/// Second derivatives N,xx N,xy N,yx N,yy at the master of moving least squares that heed the master much more than
/// the rest, as Bode 6.28: twice the symmetric gradient of the moving slope g, g,a = K^-1 sum omega_i,a X_i
/// (f_i - g.X_i).
Eigen::MatrixXd moving_second_derivatives(const Body& b, const Nodes& nodes) {
  const Eigen::Matrix2Xd X = bonds(b, nodes, 0);
  const Eigen::VectorXd w = weights(b, nodes, 0);
  const Eigen::Matrix2d inverse = (X * w.asDiagonal() * X.transpose()).inverse();
  const Eigen::MatrixXd residual =
      Eigen::MatrixXd::Identity(w.size(), w.size()) - X.transpose() * inverse * X * w.asDiagonal();
  Eigen::MatrixXd slope(4, w.size());
  for (Eigen::Index a = 0; a < 2; ++a) {
    Eigen::VectorXd dw = w;  // by the point of evaluation; w is zero at the master
    for (Eigen::Index i = 1; i < w.size(); ++i) dw[i] *= 2 * X(a, i) / X.col(i).squaredNorm();
    slope.middleRows(2 * a, 2) = inverse * X * dw.asDiagonal() * residual;
  }
  Eigen::MatrixXd N(4, w.size());
  N << 2 * slope.row(0), slope.row(1) + slope.row(2), slope.row(1) + slope.row(2), 2 * slope.row(3);
  N.col(0).setZero();
  N.col(0) = -N.rowwise().sum();
  return N;
}

double family_area(const Body& b, const Nodes& nodes) {
  double sum = 0;
  for (const int i : nodes) sum += b.areas[i];
  return sum;
}

/// A system with one sample per node of each family, weights V_k V_j / sum V.
template <typename SampleAt>
System family_integrated(const Body& b, const SampleAt& sample_at) {
  System system;
  for (const Nodes& nodes : b.families) {
    Family f{nodes, {}};
    const double area = family_area(b, nodes);
    for (int j = 0; j < int(nodes.size()); ++j) {
      f.samples.push_back(sample_at(nodes, j));
      f.samples.back().weight = b.areas[nodes[0]] * b.areas[nodes[std::size_t(j)]] / area;
    }
    system.push_back(std::move(f));
  }
  return system;
}

}  // namespace

System operator+(System a, const System& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

System operator*(double factor, System a) {
  for (Family& f : a)
    for (Sample& s : f.samples) s.weight *= factor;
  return a;
}

System central_average(const Body& b) {
  System system;
  for (const Nodes& nodes : b.families)
    system.push_back({nodes, {{Eigen::Matrix2Xd::Zero(2, nodes.size()), b.areas[nodes[0]]}}});
  for (const Triangle& t : b.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      // A grad phi_i: half the opposite side, turned inwards
      const Eigen::Vector2d side = b.points.col(t.corners[(i + 2) % 3]) - b.points.col(t.corners[(i + 1) % 3]);
      for (const int k : t.corners) {
        Family& f = system[std::size_t(k)];
        f.samples[0].gradient.col(position(f.nodes, t.corners[i])) +=
            t.share / (6 * b.areas[k]) * Eigen::Vector2d(-side.y(), side.x());
      }
    }
  return system;
}

System linear_static(const Body& b) {
  System system;
  for (const Nodes& nodes : b.families) system.push_back({nodes, {{taylor_gradient(b, nodes, 0), b.areas[nodes[0]]}}});
  return system;
}

System moving(const Body& b, bool bond_corrected) {
  return family_integrated(b, [&](const Nodes& nodes, int j) {
    const Sample s{taylor_gradient(b, nodes, j), 0, 1, j};
    return bond_corrected && j != 0 ? bond_conforming(s, bonds(b, nodes, 0).col(j)) : s;
  });
}

System quadratic_static(const Body& b) {
  return family_integrated(b, [&](const Nodes& nodes, int j) {
    const auto d = quadratic_derivatives(b, nodes);
    const Eigen::Vector2d X = bonds(b, nodes, 0).col(j);
    Sample s{d.topRows(2), 0, 1, j};
    s.gradient.row(0) += X.x() * d.row(2) + X.y() * d.row(3);
    s.gradient.row(1) += X.x() * d.row(3) + X.y() * d.row(4);
    return s;
  });
}

System bilinear(const Body& b) {
  const double gauss = 1 / std::numbers::sqrt3;
  const Eigen::Matrix<double, 2, 4> corners{{-1, 1, 1, -1}, {-1, -1, 1, 1}};
  System system;
  for (const auto& cell : b.cells) {
    Family f{{cell.begin(), cell.end()}, {}};
    const Eigen::Matrix2Xd X = bonds(b, f.nodes, 0);
    for (int g = 0; g < 4; ++g) {
      const Eigen::Vector2d at = gauss * corners.col(g);
      Eigen::Matrix2Xd d(2, 4);
      for (int i = 0; i < 4; ++i) {
        d(0, i) = corners(0, i) * (1 + corners(1, i) * at.y()) / 4;
        d(1, i) = corners(1, i) * (1 + corners(0, i) * at.x()) / 4;
      }
      const Eigen::Matrix2d jacobian = d * X.transpose();
      f.samples.push_back({jacobian.inverse() * d, jacobian.determinant()});
    }
    system.push_back(f);
  }
  return system;
}

System bond_residuals(const Body& b, const System& u1, double bending, double shear) {
  System system;
  for (const Family& master : u1) {
    Family f{master.nodes, {}};
    const Eigen::Matrix2Xd X = bonds(b, f.nodes, 0);
    const double k = b.areas[f.nodes[0]], others = family_area(b, f.nodes) - k;
    for (int j = 1; j < int(f.nodes.size()); ++j) {
      Sample s{master.samples[0].gradient, 0, 1, j};
      s = bond_conforming(s, X.col(j));
      s.gradient -= master.samples[0].gradient;
      s.weight = bending * k * b.areas[f.nodes[std::size_t(j)]] / others;
      s.shear = shear / bending;
      f.samples.push_back(s);
    }
    system.push_back(f);
  }
  return system;
}

System implicit_gradients(const Body& b) {
  System system;
  for (const Nodes& nodes : b.families) {
    const Eigen::MatrixXd d = moving_second_derivatives(b, nodes);
    const double moment = b.areas[nodes[0]] * b.areas[nodes[0]] / (4 * std::numbers::pi);
    system.push_back({nodes, {{d.topRows(2), moment}, {d.bottomRows(2), moment}}});
  }
  return system;
}

System shear_scaled(const Body& b, System system, double thickness, double c) {
  for (Family& f : system)
    for (Sample& s : f.samples) s.shear *= thickness * thickness / (thickness * thickness + c * b.areas[f.nodes[0]]);
  return system;
}

Eigen::Matrix2Xd taylor_gradient(const Body& b, const Nodes& nodes, int at) {
  return taylor_coefficients(bonds(b, nodes, at), weights(b, nodes, at), at);
}

Eigen::Matrix<double, 5, Eigen::Dynamic> quadratic_derivatives(const Body& b, const Nodes& nodes) {
  const double scale = std::sqrt(b.areas[nodes[0]]);
  Eigen::MatrixXd d = taylor_coefficients(quadratic_basis(bonds(b, nodes, 0), scale), weights(b, nodes, 0), 0);
  d.topRows(2) /= scale;
  d.bottomRows(3) /= scale * scale;
  return d;
}

}  // namespace galerkin_systems
