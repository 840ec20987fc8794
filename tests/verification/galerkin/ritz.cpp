// Polynomial Ritz solutions of the Mindlin square, by parity: Legendre polynomials, times 1 - x^2 where an edge is
// held.
#include <Eigen/Eigenvalues>
#include <algorithm>

#include "tests/dense.hpp"
#include "tests/verification/galerkin/plate.hpp"

namespace galerkin_systems {
namespace {

/// Functions of one coordinate at the Gauss points of [-1/2, 1/2], points x functions.
struct Line {
  Eigen::MatrixXd value, slope;
};

struct Gauss {
  Eigen::VectorXd points, weights;  ///< of [-1, 1]
};

/// Golub and Welsch: the eigenvalues of the recursion's matrix.
Gauss gauss(int n) {
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(n, n);
  for (int i = 1; i < n; ++i) jacobi(i, i - 1) = i / std::sqrt(4.0 * i * i - 1);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(jacobi);
  return {solver.eigenvalues(), 2 * solver.eigenvectors().row(0).transpose().cwiseAbs2()};
}

/// Legendre polynomials of one parity up to `degree` at x of [-1, 1]; slopes by d/dX, X = x / 2.
Line line(const Eigen::VectorXd& x, int degree, int parity, bool held) {
  Eigen::MatrixXd P = Eigen::MatrixXd::Ones(x.size(), degree + 1), dP = Eigen::MatrixXd::Zero(x.size(), degree + 1);
  if (degree > 0) P.col(1) = x, dP.col(1).setOnes();
  for (int n = 2; n <= degree; ++n) {
    P.col(n) = ((2 * n - 1) * x.cwiseProduct(P.col(n - 1)) - (n - 1) * P.col(n - 2)) / n;
    dP.col(n) = dP.col(n - 2) + (2 * n - 1) * P.col(n - 1);
  }
  Line l{Eigen::MatrixXd(x.size(), 0), Eigen::MatrixXd(x.size(), 0)};
  for (int n = parity; n <= degree; n += 2) {
    l.value.conservativeResize(Eigen::NoChange, l.value.cols() + 1);
    l.slope.conservativeResize(Eigen::NoChange, l.value.cols());
    const Eigen::ArrayXd bubble = 1 - (held ? 1 : 0) * x.array().square();
    const Eigen::ArrayXd fall = (held ? -2 : 0) * x.array();
    l.value.rightCols(1) = (bubble * P.col(n).array()).matrix();
    l.slope.rightCols(1) = (2 * (bubble * dP.col(n).array() + fall * P.col(n).array())).matrix();
  }
  return l;
}

/// f(x) g(y) at the pairs of Gauss points, pairs x pairs of functions.
Eigen::MatrixXd product(const Eigen::MatrixXd& f, const Eigen::MatrixXd& g) {
  Eigen::MatrixXd table(f.rows() * g.rows(), f.cols() * g.cols());
  for (Eigen::Index i = 0; i < f.rows(); ++i)
    for (Eigen::Index a = 0; a < f.cols(); ++a)
      table.block(i * g.rows(), a * g.cols(), g.rows(), g.cols()) = f(i, a) * g;
  return table;
}

struct Matrices {
  Eigen::MatrixXd stiffness, mass;
  Eigen::VectorXd pressure, centre;  ///< unit pressure's load; w at the centre
};

/// One parity class: w is (px, py) in (x, y), psi_x (1 - px, py), psi_y (px, 1 - py).
Matrices matrices(const Plate& p, Held held, int degree, int px, int py) {
  const Gauss rule = gauss(degree + 4);
  const bool w_held = held != Held::free, psi_held = held == Held::clamped;
  const auto at = [&](int parity, bool bubble) { return line(rule.points, degree, parity, bubble); };
  const Line wx = at(px, w_held), wy = at(py, w_held), ux = at(1 - px, psi_held), uy = at(py, w_held),
             vx = at(px, w_held), vy = at(1 - py, psi_held);
  const Eigen::MatrixXd w = product(wx.value, wy.value), u = product(ux.value, uy.value),
                        v = product(vx.value, vy.value);
  const Eigen::VectorXd weight = product(rule.weights, rule.weights) / 4;
  const Eigen::Index nw = w.cols(), nu = u.cols(), nv = v.cols(), n = nw + nu + nv, q = weight.size();
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n), M = K, B(q, n);
  const auto add = [&](Eigen::MatrixXd& sum, double factor) {
    sum += factor * B.transpose() * weight.asDiagonal() * B;
  };
  const Eigen::MatrixXd none_w = Eigen::MatrixXd::Zero(q, nw), none_u = Eigen::MatrixXd::Zero(q, nu),
                        none_v = Eigen::MatrixXd::Zero(q, nv);
  const Eigen::MatrixXd kx = product(ux.slope, uy.value), ky = product(vx.value, vy.slope);
  B << none_w, kx, none_v;
  add(K, p.D() * (1 - p.poisson));
  B << none_w, none_u, ky;
  add(K, p.D() * (1 - p.poisson));
  B << none_w, kx, ky;
  add(K, p.D() * p.poisson);
  B << none_w, product(ux.value, uy.slope), product(vx.slope, vy.value);
  add(K, p.D() * (1 - p.poisson) / 2);
  B << product(wx.slope, wy.value), -u, none_v;
  add(K, p.kG());
  B << product(wx.value, wy.slope), none_u, -v;
  add(K, p.kG());
  const double inertia = p.density * p.thickness * p.thickness * p.thickness / 12;
  B << w, none_u, none_v;
  add(M, p.density * p.thickness);
  Eigen::VectorXd pressure = B.transpose() * weight;
  B << none_w, u, none_v;
  add(M, inertia);
  B << none_w, none_u, v;
  add(M, inertia);
  const Eigen::VectorXd origin = Eigen::VectorXd::Zero(1);
  Eigen::VectorXd centre = Eigen::VectorXd::Zero(n);
  centre.head(nw) = product(line(origin, degree, px, w_held).value, line(origin, degree, py, w_held).value).transpose();
  return {K, M, pressure, centre};
}

}  // namespace

Eigen::VectorXd ritz_frequencies(const Plate& plate, int degree) {
  std::vector<double> all;
  for (int px = 0; px < 2; ++px)
    for (int py = 0; py < 2; ++py) {
      const Matrices m = matrices(plate, Held::free, degree, px, py);
      const Eigen::VectorXd values = dense::eigenvalues(m.stiffness, m.mass);
      all.insert(all.end(), values.begin(), values.end());
    }
  std::sort(all.begin(), all.end());
  return Eigen::Map<Eigen::VectorXd>(all.data(), Eigen::Index(all.size()));
}

double ritz_deflection(const Plate& plate, Held held, int degree) {
  const Matrices m = matrices(plate, held, degree, 0, 0);
  return m.centre.dot(dense::solution(m.stiffness, m.pressure));
}

}  // namespace galerkin_systems
