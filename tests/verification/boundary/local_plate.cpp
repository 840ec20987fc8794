#include "tests/verification/boundary/local_plate.hpp"

#include <numbers>
#include "tests/dense.hpp"

namespace boundary_bodies {

namespace {

using plate::SupportKind;

/// Fejer's rule on -1 ... 1: place and weight.
std::pair<double, double> quadrature(int i, int points) {
  const double t = (i + 0.5) * std::numbers::pi / points;
  double sum = 0;
  for (int k = 1; k <= points / 2; ++k) sum += std::cos(2 * k * t) / (4.0 * k * k - 1);
  return {std::cos(t), 2.0 / points * (1 - 2 * sum)};
}

/// P_i and its slope.
std::pair<double, double> legendre(int i, double t) {
  double p = 1, before = 0, slope = 0, slope_before = 0;
  for (int k = 0; k < i; ++k) {
    const double next = ((2 * k + 1) * t * p - k * before) / (k + 1), next_slope = slope_before + (2 * k + 1) * p;
    before = p, p = next, slope_before = slope, slope = next_slope;
  }
  return {p, slope};
}

}  // namespace

RitzPlate::RitzPlate(const plate::Section& section, double side, double pressure, SupportKind x, SupportKind y,
                     int count)
    : half_(side / 2), count_(count) {
  for (const int axis : {0, 1}) {
    const SupportKind kind = axis == 0 ? x : y;
    const bool clamped = kind == SupportKind::clamped, hard = kind == SupportKind::simply_supported_hard;
    vanishes_[0][axis] = kind != SupportKind::free;
    vanishes_[1 + axis][axis] = clamped;          // psi_n
    vanishes_[2 - axis][axis] = clamped || hard;  // psi_s
  }
  const double D = section.bending_stiffness(), nu = section.poisson, S = section.shear_stiffness();
  Eigen::MatrixXd law = Eigen::MatrixXd::Zero(5, 5);
  law.topLeftCorner<3, 3>() = D * Eigen::Matrix3d{{1, nu, 0}, {nu, 1, 0}, {0, 0, (1 - nu) / 2}};
  law.bottomRightCorner<2, 2>() = S * Eigen::Matrix2d::Identity();
  const int all = 3 * count * count, points = 4 * count + 12;  // more than the degree of the integrands
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(all, all);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(all);
  for (int a = 0; a < points / 2; ++a)
    for (int b = 0; b < points / 2; ++b) {  // a quarter: symmetric
      const auto [s, ws] = quadrature(a, points);
      const auto [t, wt] = quadrature(b, points);
      const double area = ws * wt * half_ * half_;
      const Eigen::MatrixXd strain = strains(s * half_, t * half_);
      K.noalias() += area * strain.transpose() * law * strain;
      f += area * pressure * deflections(s * half_, t * half_).transpose();
    }
  weights_ = dense::solution(K, f);
}

RitzPlate::Shape RitzPlate::shape(int field, int axis, int i, double t) const {
  const auto [p, slope] = legendre(2 * i + (field == 1 + axis), t);  // w even; psi_x odd in x, even in y
  if (!vanishes_[field][axis]) return {p, slope / half_};
  return {(1 - t * t) * p, ((1 - t * t) * slope - 2 * t * p) / half_};
}

Eigen::RowVectorXd RitzPlate::deflections(double x, double y) const {
  Eigen::RowVectorXd result = Eigen::RowVectorXd::Zero(3 * count_ * count_);
  for (int i = 0; i < count_; ++i)
    for (int j = 0; j < count_; ++j)
      result[i * count_ + j] = shape(0, 0, i, x / half_).value * shape(0, 1, j, y / half_).value;
  return result;
}

Eigen::MatrixXd RitzPlate::strains(double x, double y) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(5, 3 * count_ * count_);
  for (int field = 0; field < 3; ++field)
    for (int i = 0; i < count_; ++i)
      for (int j = 0; j < count_; ++j) {
        const Shape p = shape(field, 0, i, x / half_), q = shape(field, 1, j, y / half_);
        auto column = result.col((field * count_ + i) * count_ + j);
        const double by_x = p.slope * q.value, by_y = p.value * q.slope, value = p.value * q.value;
        if (field == 0) column << 0, 0, 0, by_x, by_y;
        if (field == 1) column << by_x, 0, by_y, -value, 0;
        if (field == 2) column << 0, by_y, by_x, 0, -value;
      }
  return result;
}

double RitzPlate::deflection(double x, double y) const {
  return deflections(x, y) * weights_;
}

}  // namespace boundary_bodies
