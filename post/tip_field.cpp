#include "post/tip_field.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

namespace post {
namespace {

using std::numbers::pi;
constexpr std::complex<double> i{0, 1};

/// w and the rotations of one solution without load, lengths in thicknesses, D = 1.
struct Solution {
  PowerSum w, psi_x, psi_y;

};

double shear_stiffness(const plate::Section& s) {  // S h^2 / D
  return 6 * s.shear_correction * (1 - s.poisson);
}

PowerSum M_yy(const Solution& u, double nu) {
  PowerSum sum = u.psi_y.dy();
  sum += u.psi_x.dx() * nu;
  return sum;
}

PowerSum M_xx(const Solution& u, double nu) {
  PowerSum sum = u.psi_x.dx();
  sum += u.psi_y.dy() * nu;
  return sum;
}

PowerSum M_xy(const Solution& u, double nu) {
  PowerSum sum = u.psi_x.dy();
  sum += u.psi_y.dx();
  return sum * ((1 - nu) / 2);
}

PowerSum Q_x(const Solution& u, double S) {
  PowerSum sum = u.w.dx();
  sum += u.psi_x * -1;
  return sum * S;
}

PowerSum Q_y(const Solution& u, double S) {
  PowerSum sum = u.w.dy();
  sum += u.psi_y * -1;
  return sum * S;
}

/// w biharmonic, psi = grad(w + lap w / S).
Solution bending(const PowerSum& w, double S) {
  PowerSum potential = w.dx().dx();
  potential += w.dy().dy();
  potential = potential * (1 / S);
  potential += w;
  return {w, potential.dx(), potential.dy()};
}

/// psi = rot chi, chi = I_m(lambda r) of the angle, lambda^2 = 2 S / (1 - nu).
Solution twisting(int twice_m, std::complex<double> phase, double lambda, int highest) {
  PowerSum chi;
  const double m = twice_m / 2.0;
  double factor = 1 / std::tgamma(m + 1);
  for (int k = 0; twice_m + 4 * k <= highest + 2; ++k) {
    chi += PowerSum::term(twice_m + 4 * k, twice_m, phase * factor * std::pow(lambda / 2, m + 2 * k));
    factor /= (k + 1) * (m + k + 1);
  }
  return {{}, chi.dy(), chi.dx() * -1};
}

constexpr int highest = 33;  // twice the highest power of w

/// All solutions of one symmetry: w even or odd in y'.
std::vector<Solution> solutions(bool even, double S, double lambda) {
  std::vector<Solution> result;
  const std::complex<double> w_phase = even ? 1.0 : -i, chi_phase = even ? -i : 1.0;  // Re: cos or sin
  for (int p = 1; p <= highest; p += 2)
    for (const int q : {p, p - 4}) result.push_back(bending(PowerSum::term(p, q, w_phase), S));
  for (int m = -3; m <= highest; m += 2) result.push_back(twisting(m, chi_phase, lambda, highest));
  return result;
}

/// Moments and shear forces of every solution on circles about the tip, and tractions of the faces, which must vanish and
/// so count more.
Eigen::MatrixXd stresses_about_tip(const std::vector<Solution>& basis, double nu, double S) {
  constexpr double traction_weight = 1e4;
  std::vector<Polar> places, faces;
  for (const double r : {0.4, 0.7, 1.0, 1.3})
    for (int n = 0; n <= 12; ++n) places.push_back({r, n * pi / 12});
  for (int n = 1; n <= 30; ++n) faces.push_back({n * TipField::reach / 30, pi});
  Eigen::MatrixXd result(Eigen::Index(5 * places.size() + 3 * faces.size()), Eigen::Index(basis.size()));
  for (Eigen::Index n = 0; n < result.cols(); ++n) {
    const Solution& u = basis[std::size_t(n)];
    Eigen::Index row = 0;
    for (const auto& stress : {M_xx(u, nu), M_yy(u, nu), M_xy(u, nu), Q_x(u, S), Q_y(u, S)})
      for (const auto& place : places) result(row++, n) = stress(place);
    for (const auto& traction : {M_yy(u, nu), M_xy(u, nu), Q_y(u, S)})
      for (const auto& face : faces) result(row++, n) = traction_weight * traction(face);
  }
  return result;
}

}  // namespace

PowerSum PowerSum::term(int twice_p, int twice_q, std::complex<double> c) {
  PowerSum sum;
  sum.terms_[{twice_p, twice_q}] = c;
  return sum;
}

PowerSum& PowerSum::operator+=(const PowerSum& other) {
  for (const auto& [key, c] : other.terms_) terms_[key] += c;
  return *this;
}

PowerSum PowerSum::operator*(double factor) const {
  PowerSum result = *this;
  for (auto& [key, c] : result.terms_) c *= factor;
  return result;
}

// with z = x + i y: d/dz r^p e^(iqa) = (p + q)/2 r^(p-1) e^(i(q-1)a), and its mirror image for the conjugate
PowerSum PowerSum::dx() const {
  PowerSum result;
  for (const auto& [key, c] : terms_) {
    const auto [p, q] = key;
    if (p + q != 0) result.terms_[{p - 2, q - 2}] += c * ((p + q) / 4.0);
    if (p - q != 0) result.terms_[{p - 2, q + 2}] += c * ((p - q) / 4.0);
  }
  return result;
}

PowerSum PowerSum::dy() const {
  PowerSum result;
  for (const auto& [key, c] : terms_) {
    const auto [p, q] = key;
    if (p + q != 0) result.terms_[{p - 2, q - 2}] += i * c * ((p + q) / 4.0);
    if (p - q != 0) result.terms_[{p - 2, q + 2}] -= i * c * ((p - q) / 4.0);
  }
  return result;
}

double PowerSum::operator()(const Polar& at) const {
  if (terms_.empty()) return 0;
  // terms come in ascending powers: the turn e^(i q a) for all q once, the powers of the root one after the other
  constexpr int most = 96;
  std::array<std::complex<double>, 2 * most + 1> turn;
  const auto half = std::polar(1.0, at.angle / 2);
  turn[most] = 1;
  for (int q = 1; q <= most; ++q) turn[std::size_t(most + q)] = turn[std::size_t(most + q - 1)] * half;
  for (int q = 1; q <= most; ++q) turn[std::size_t(most - q)] = std::conj(turn[std::size_t(most + q)]);
  const double root = std::sqrt(at.r);
  int power = terms_.begin()->first.first;
  double scale = std::pow(at.r, power / 2.0), sum = 0;
  for (const auto& [key, c] : terms_) {
    for (; power < key.first; ++power) scale *= root;
    sum += scale * (c * turn[std::size_t(most + key.second)]).real();
  }
  return sum;
}

double PowerSum::coefficient(int twice_p, double angle) const {
  double sum = 0;
  for (auto entry = terms_.lower_bound({twice_p, -1000}); entry != terms_.end() && entry->first.first == twice_p; ++entry)
    sum += (entry->second * std::polar(1.0, entry->first.second / 2.0 * angle)).real();
  return sum;
}

namespace {

/// Spacings; points of a face are seen 2e-6 of the distance to their neighbours beside it, some half a spacing.
constexpr double on_line = 1e-7;

}  // namespace

int face_of(double y, const geometry::Point& left, double spacing) {
  if (std::abs(y) > on_line * spacing) return y > 0 ? 1 : -1;
  const double towards = std::abs(left.x()) > 1e-12 ? left.x() : left.y();
  return towards > 0 ? 1 : -1;
}

Polar polar(const TipFrame& frame, const geometry::Point& x, double spacing) {
  const auto at = frame.local(x);
  if (at.x() < 0 && std::abs(at.y()) <= on_line * spacing) return {-at.x(), face_of(0, frame.left(), spacing) * pi};
  return {at.norm(), std::atan2(at.y(), at.x())};
}

TipField::TipField(const plate::Section& section, int mode) : section_(section) {
  const double nu = section.poisson, S = shear_stiffness(section), lambda = std::sqrt(2 * S / (1 - nu));
  const auto basis = solutions(mode == 0, S, lambda);

  // linear conditions on the factors of the basis: no power of psi below 1/2, free faces, and the wanted K
  std::vector<std::vector<double>> rows;
  std::vector<double> wanted;
  const auto require = [&](const auto& value, double target) {
    rows.emplace_back();
    for (const auto& solution : basis) rows.back().push_back(value(solution));
    wanted.push_back(target);
  };
  for (int p = -9; p <= -1; p += 2)
    for (const double angle : {0.0, 0.4, 0.9, 1.5, 2.1, 2.6, pi}) {
      require([&](const Solution& u) { return u.psi_x.coefficient(p, angle); }, 0);
      require([&](const Solution& u) { return u.psi_y.coefficient(p, angle); }, 0);
    }
  for (int p = -11; p <= 5; p += 2) {
    require([&](const Solution& u) { return M_yy(u, nu).coefficient(p, pi); }, 0);
    require([&](const Solution& u) { return M_xy(u, nu).coefficient(p, pi); }, 0);
    require([&](const Solution& u) { return Q_y(u, S).coefficient(p, pi); }, 0);
  }
  // K1 = -K D / sqrt(h), K3 = K D / h^(3/2) for K = lim sqrt(2r) ... of D grad psi and S gamma, in thicknesses
  const double D = section.bending_stiffness(), h = section.thickness, unit = std::sqrt(h) / D / std::sqrt(2.0);
  // no next term of the singular stresses ahead: it would measure how far the tip lies from its place, times dK/da
  if (mode == 0) {
    require([&](const Solution& u) { return M_yy(u, nu).coefficient(-1, 0); }, -unit);
    require([&](const Solution& u) { return M_yy(u, nu).coefficient(1, 0); }, 0);
  } else {
    require([&](const Solution& u) { return M_xy(u, nu).coefficient(1, 0); }, 0);
    require([&](const Solution& u) { return Q_y(u, S).coefficient(1, 0); }, 0);
    require([&](const Solution& u) { return M_xy(u, nu).coefficient(-1, 0); }, mode == 1 ? -unit : 0);
    require([&](const Solution& u) { return Q_y(u, S).coefficient(-1, 0); }, mode == 2 ? unit * h : 0);
  }

  Eigen::MatrixXd matrix(Eigen::Index(rows.size()), Eigen::Index(basis.size()));
  for (Eigen::Index r = 0; r < matrix.rows(); ++r)
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) matrix(r, c) = rows[std::size_t(r)][std::size_t(c)];
  const Eigen::VectorXd target = Eigen::Map<Eigen::VectorXd>(wanted.data(), Eigen::Index(wanted.size()));
  // columns scaled, so that high powers, with their large derivatives, count as much as low ones
  const Eigen::MatrixXd plain_stresses = stresses_about_tip(basis, nu, S);
  const Eigen::VectorXd scale =
      (matrix.colwise().squaredNorm() + plain_stresses.colwise().squaredNorm()).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = matrix * scale.asDiagonal();
  Eigen::JacobiSVD<Eigen::MatrixXd> solver(scaled, Eigen::ComputeFullU | Eigen::ComputeFullV);
  solver.setThreshold(1e-11);
  // the conditions leave free what belongs to higher powers: of all solutions the one with the least stresses about the tip
  const Eigen::MatrixXd stresses = plain_stresses * scale.asDiagonal();
  const Eigen::MatrixXd free = solver.matrixV().rightCols(scaled.cols() - solver.rank());
  const Eigen::VectorXd first = solver.solve(target);
  const Eigen::VectorXd factors =
      scale.asDiagonal() * (first - free * (stresses * free).colPivHouseholderQr().solve(stresses * first));
  for (Eigen::Index n = 0; n < factors.size(); ++n) {
    w_ += basis[std::size_t(n)].w * factors[n];
    psi_x_ += basis[std::size_t(n)].psi_x * factors[n];
    psi_y_ += basis[std::size_t(n)].psi_y * factors[n];
  }
  w_slope_ = w_.dx(), psi_x_slope_ = psi_x_.dx(), psi_y_slope_ = psi_y_.dx();
}

Eigen::Vector3d TipField::operator()(const Polar& at) const {
  const double h = section_.thickness;
  const Polar scaled{at.r / h, at.angle};
  return {h * w_(scaled), psi_x_(scaled), psi_y_(scaled)};
}

Eigen::Vector3d TipField::along_crack(const Polar& at) const {
  const double h = section_.thickness;
  const Polar scaled{at.r / h, at.angle};
  return {w_slope_(scaled), psi_x_slope_(scaled) / h, psi_y_slope_(scaled) / h};
}

Eigen::Vector3d TipField::moments(const Polar& at) const {
  const double h = section_.thickness, D = section_.bending_stiffness(), nu = section_.poisson;
  const Solution u{w_, psi_x_, psi_y_};
  const Polar scaled{at.r / h, at.angle};
  return -D / h * Eigen::Vector3d(M_xx(u, nu)(scaled), M_yy(u, nu)(scaled), M_xy(u, nu)(scaled));
}

Eigen::Vector2d TipField::shear(const Polar& at) const {
  const double h = section_.thickness, S = shear_stiffness(section_);
  const Solution u{w_, psi_x_, psi_y_};
  const Polar scaled{at.r / h, at.angle};
  return section_.bending_stiffness() / (h * h) * Eigen::Vector2d(Q_x(u, S)(scaled), Q_y(u, S)(scaled));
}

}  // namespace post
