#include "post/factors/tip_section.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <numbers>

namespace post {
namespace {

/// Determinants of numbers near the ends of double precision are beyond it.
Eigen::Matrix3d inverse(const Eigen::Matrix3d& matrix) {
  const double size = matrix.cwiseAbs().maxCoeff();
  return (matrix / size).inverse() / size;
}

}  // namespace

Eigen::Matrix3d turned_compliance(const Eigen::Matrix3d& bending, const geometry::Point& ahead) {
  const double c = ahead.x(), s = ahead.y();
  Eigen::Matrix3d turn;  // curvatures xx, yy, 2 xy in those axes by those along x and y
  turn << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s, 2 * c * s, c * c - s * s;
  return turn * inverse(bending) * turn.transpose();
}

std::pair<std::complex<double>, std::complex<double>> upper_roots(const Eigen::Matrix3d& a) {
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(4, 4);
  companion(1, 0) = companion(2, 1) = companion(3, 2) = 1;
  companion.col(3) = Eigen::Vector4d(-a(1, 1), 2 * a(1, 2), -(2 * a(0, 1) + a(2, 2)), 2 * a(0, 2)) / a(0, 0);
  const auto values = Eigen::EigenSolver<Eigen::MatrixXd>(companion, false).eigenvalues();
  std::complex<double> sum = 0, product = 1;
  for (Eigen::Index i = 0; i < 4; ++i)
    if (values[i].imag() > 0) sum += values[i], product *= values[i];
  return {sum, product};
}

TipSection::TipSection(const plate::Section& own, const geometry::Point& ahead)
    : section(own), compliance(Eigen::Matrix3d::Zero()) {
  if (own.isotropic() && own.law == plate::PlateLaw::membrane) {
    compliance(0, 0) = compliance(1, 1) = 2 / (own.young * own.thickness);
    return;
  }
  if (own.isotropic()) {
    const double bending = 24 / (own.young * own.thickness * own.thickness * own.thickness);
    compliance.diagonal() << bending, bending, 1 / own.shear_stiffness();
    return;
  }
  const plate::LocalSection local(own);
  const auto a = turned_compliance(local.bending, ahead);
  const auto [sum, product] = upper_roots(a);
  compliance(0, 0) = -a(1, 1) * (sum / product).imag();
  compliance(1, 1) = a(0, 0) * sum.imag();
  compliance(0, 1) = compliance(1, 0) = a(0, 0) * product.imag();
  if (own.law == plate::PlateLaw::bending) compliance(2, 2) = 1 / std::sqrt(local.shear.determinant());
}

Eigen::Matrix3d TipSection::stiffness() const {
  if (section.law == plate::PlateLaw::bending) return inverse(compliance);
  Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
  result.topLeftCorner<2, 2>() = compliance.topLeftCorner<2, 2>().inverse();
  return result;
}

double TipSection::release(const Eigen::Vector3d& K) const {
  return std::numbers::pi / 2 * K.dot(compliance * K);
}

Eigen::Vector3d TipSection::unit_release() const {
  return std::numbers::pi / 2 * compliance.diagonal();
}

Eigen::Vector3d factors(double G, const Eigen::Vector3d& split, const TipSection& at) {
  const double bending = at.release({split[0], split[1], 0}), shear = at.release({0, 0, split[2]}), rest = G - shear;
  if (G <= 0 || bending + shear <= 0) return {0, 0, 0};
  if (bending <= 0 || rest <= 0.05 * G) return split * std::sqrt(G / (bending + shear));
  const double scale = std::sqrt(rest / bending);
  return {scale * split[0], scale * split[1], split[2]};
}

}  // namespace post
