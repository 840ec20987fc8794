#pragma once
#include <cmath>

/// What one bond does: the formulas of theory.md, "Bond law" (Dai et al. 2021, Eqs. 1-13, with the two swapped
/// parameters of Eq. 7 put right), written per pair of points with areas A_k, A_j.
namespace plate {

/// Geometry of a bond k -> j. The rotation along the bond is n . psi = m . theta with psi = (-theta_y, theta_x)
/// and m = (n_y, -n_x).
struct BondShape {
  double mx, my;   // m
  double length;   // xi [length]
  double weight;   // omega(xi) beta h [length]; times A_j: omega V_j
};

/// One end of a bond: w, theta_x, theta_y.
struct Kinematics {
  double w, theta_x, theta_y;
};

/// s xi = n . (psi_j - psi_k): bond curvature times length (Eq. 3).
inline double curvature_difference(const BondShape& bond, const Kinematics& k, const Kinematics& j) {
  return bond.mx * (j.theta_x - k.theta_x) + bond.my * (j.theta_y - k.theta_y);
}

/// gamma xi: bond shear angle times length (the bracket of Eq. 2).
inline double shear_difference(const BondShape& bond, const Kinematics& k, const Kinematics& j) {
  return j.w - k.w -
         bond.length / 2 * (bond.mx * (k.theta_x + j.theta_x) + bond.my * (k.theta_y + j.theta_y));
}

/// Force on w and couple along m on point k; theta gets m * couple.
struct BondForce {
  double force, couple;
};

/// Force of the bond on point k (Eqs. 11-13 with the pair averages that follow from the energy):
/// q = 2 a_b d_b theta_b, b = b_b, C = C_s of the two points; pair = A_k A_j weight.
inline BondForce bond_force(const BondShape& bond, double pair, double q_sum, double b_sum, double shear_mean,
                            double curvature_difference, double shear_difference) {
  const double force = pair * shear_mean * shear_difference;
  return {force, pair * (q_sum + 2 * b_sum * curvature_difference) + force * bond.length / 2};
}

/// Energy that point k books for the bond, per A_k (the sums of Eqs. 1 and 2): omega V_j (b s^2 + C gamma^2 / 4) xi^2.
inline double bond_energy(const BondShape& bond, double area_j, double b, double shear, double curvature_difference,
                          double shear_difference) {
  return bond.weight * area_j *
         (b * curvature_difference * curvature_difference + shear / 4 * shear_difference * shear_difference);
}

}  // namespace plate
