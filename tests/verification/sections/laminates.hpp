#pragma once
#include <Eigen/Eigenvalues>
#include <numbers>

#include "tests/verification/sections/plates_of_sections.hpp"

/// Laminates of unidirectional plies, whose bending and stretching may be coupled.
namespace laminates {

using namespace plate;

constexpr double pi = std::numbers::pi;

using Matrix5 = Eigen::Matrix<double, 5, 5>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

inline Ply ply(double angle, double thickness) {
  Ply result;
  static_cast<Orthotropy&>(result) = {25000, 1000, 0.25, 500, 500, 200, angle};
  result.thickness = thickness;
  return result;
}

inline Section of_plies(std::vector<Ply> plies) {
  Section s{0, 0, 0, 5.0 / 6, 2};
  for (const auto& one : plies) s.thickness += one.thickness;
  s.plies = std::move(plies);
  return s;
}

/// Reduced stiffness of a ply turned from its axes (Reddy, Mechanics of Laminated Composite Plates, 2.4.8).
inline Eigen::Matrix3d turned_stiffness(const Ply& p) {
  const double c = std::cos(p.angle * pi / 180), s = std::sin(p.angle * pi / 180),
               rest = 1 - p.nu12 * p.nu12 * p.E2 / p.E1;
  const double Q11 = p.E1 / rest, Q22 = p.E2 / rest, Q12 = p.nu12 * p.E2 / rest, Q66 = p.G12;
  const double a = c * c * c * c, b = s * s * s * s, d = s * s * c * c;
  Eigen::Matrix3d Q;
  Q(0, 0) = Q11 * a + 2 * (Q12 + 2 * Q66) * d + Q22 * b;
  Q(1, 1) = Q11 * b + 2 * (Q12 + 2 * Q66) * d + Q22 * a;
  Q(0, 1) = Q(1, 0) = (Q11 + Q22 - 4 * Q66) * d + Q12 * (a + b);
  Q(2, 2) = (Q11 + Q22 - 2 * Q12 - 2 * Q66) * d + Q66 * (a + b);
  Q(0, 2) = Q(2, 0) = (Q11 - Q12 - 2 * Q66) * s * c * c * c + (Q12 - Q22 + 2 * Q66) * s * s * s * c;
  Q(1, 2) = Q(2, 1) = (Q11 - Q12 - 2 * Q66) * s * s * s * c + (Q12 - Q22 + 2 * Q66) * s * c * c * c;
  return Q;
}

/// N and M by the strains and curvatures of the middle plane.
inline Matrix6 laminate(const Section& section) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero(), B = A, D = A;
  double z = -section.thickness / 2;
  for (const auto& one : section.plies) {
    const double end = z + one.thickness;
    const auto Q = turned_stiffness(one);
    A += (end - z) * Q, B += (end * end - z * z) / 2 * Q, D += (end * end * end - z * z * z) / 3 * Q;
    z = end;
  }
  Matrix6 result;
  result << A, B, B, D;
  return result;
}

/// Stiffness of Navier's solution of the laminate of first order (Reddy 2004, 7.4.2) of an antisymmetric cross-ply
/// rectangle a x b: SS-1, v = w = phi_y = 0 on x = 0, a and u = w = phi_x = 0 on y = 0, b. By amplitudes of u, v, w,
/// phi_x, phi_y of the wave m, n.
inline Matrix5 navier_stiffness(const Section& section, double a, double b, int m, int n) {
  const Matrix6 K = laminate(section);
  const auto A = [&](int i, int j) { return K(i, j); };
  const auto B = [&](int i, int j) { return K(i, 3 + j); };
  const auto D = [&](int i, int j) { return K(3 + i, 3 + j); };
  double S55 = 0, S44 = 0;
  for (const auto& one : section.plies) {
    const bool along = one.angle == 0;
    S55 += section.shear_correction * one.thickness * (along ? one.G13 : one.G23);
    S44 += section.shear_correction * one.thickness * (along ? one.G23 : one.G13);
  }
  const double x = m * pi / a, y = n * pi / b;
  Matrix5 S;
  S.setZero();
  S(0, 0) = A(0, 0) * x * x + A(2, 2) * y * y, S(0, 1) = (A(0, 1) + A(2, 2)) * x * y;
  S(1, 1) = A(2, 2) * x * x + A(1, 1) * y * y;
  S(0, 3) = B(0, 0) * x * x + B(2, 2) * y * y, S(0, 4) = S(1, 3) = (B(0, 1) + B(2, 2)) * x * y;
  S(1, 4) = B(2, 2) * x * x + B(1, 1) * y * y;
  S(2, 2) = S55 * x * x + S44 * y * y, S(2, 3) = S55 * x, S(2, 4) = S44 * y;
  S(3, 3) = D(0, 0) * x * x + D(2, 2) * y * y + S55, S(3, 4) = (D(0, 1) + D(2, 2)) * x * y;
  S(4, 4) = D(2, 2) * x * x + D(1, 1) * y * y + S44;
  return S.selfadjointView<Eigen::Upper>();
}

}  // namespace laminates
