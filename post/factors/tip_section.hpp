#pragma once
#include <complex>
#include <utility>

#include "plate/model/section.hpp"

namespace post {

/// The section at a tip, and what the leading field makes of intensity factors there (theory.md, "Sections with
/// directions"; Sih, Paris and Irwin 1965): sqrt(8 r) Lambda K are the jumps r behind the tip of -psi to the left, of
/// -psi ahead and of w.
struct TipSection {
  plate::Section section;
  Eigen::Matrix3d compliance;  // Lambda; of a membrane, which has no third factor, zero there

  /// `section`: the same everywhere. `ahead`: direction of the tip.
  TipSection(const plate::Section& section, const geometry::Point& ahead = {1, 0});

  /// G = pi / 2 K . Lambda K [force] (theory (50)).
  double release(const Eigen::Vector3d& K) const;
  /// Inverse of Lambda.
  Eigen::Matrix3d stiffness() const;
  /// G of unit factors: of isotropic sections G = g1 (K1^2 + K2^2) + g3 K3^2.
  Eigen::Vector3d unit_release() const;
};

/// Curvatures xx, yy, 2 xy by moments, in axes ahead and to the left.
Eigen::Matrix3d turned_compliance(const Eigen::Matrix3d& bending, const geometry::Point& ahead);

/// Sum and product of the two roots above the real axis of a11 m^4 - 2 a16 m^3 + (2 a12 + a66) m^2 - 2 a26 m + a22
/// (Lekhnitskii): both are exact where the roots are double.
std::pair<std::complex<double>, std::complex<double>> upper_roots(const Eigen::Matrix3d& compliance);

/// Factors with the energy release rate G and the mode mix of `split`: K3 as it is, K1 and K2 take the rest.
Eigen::Vector3d factors(double G, const Eigen::Vector3d& split, const TipSection& at);

}  // namespace post
