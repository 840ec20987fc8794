#pragma once

/// What one bond does: the formulas of theory.md, "Bond law" (Dai et al. 2021, Eqs. 1-13, with the two swapped
/// parameters of Eq. 7 put right), written per pair of points with areas A_k, A_j. `Value` is a number, or an array of
/// numbers for as many pairs at once.
namespace plate {

/// Geometry of a bond k -> j. The rotation along the bond is n . psi = m . theta with psi = (-theta_y, theta_x)
/// and m = (n_y, -n_x).
struct BondShape {
  double mx, my;  // m
  double length;  // xi [length]
  double weight;  // omega(xi) beta h [length]; times A_j: omega V_j
};

/// One end of a bond.
template <typename Value = double>
struct Kinematics {
  Value w, theta_x, theta_y;
};

/// s xi = n . (psi_j - psi_k): bond curvature times length (Eq. 3).
template <typename Value>
Value curvature_difference(const BondShape& bond, const Kinematics<Value>& k, const Kinematics<Value>& j) {
  return bond.mx * (j.theta_x - k.theta_x) + bond.my * (j.theta_y - k.theta_y);
}

/// gamma xi: bond shear angle times length (the bracket of Eq. 2).
template <typename Value>
Value shear_difference(const BondShape& bond, const Kinematics<Value>& k, const Kinematics<Value>& j) {
  return j.w - k.w - bond.length / 2 * (bond.mx * (k.theta_x + j.theta_x) + bond.my * (k.theta_y + j.theta_y));
}

/// Force on w and couple along m on point k; theta gets m * couple.
template <typename Value>
struct BondForce {
  Value force, couple;
};

/// Force of the bond on point k (Eqs. 11-13 with the pair averages that follow from the energy):
/// q = 2 a_b d_b theta_b, b = b_b, C = C_s of the two points; pair = A_k A_j weight.
template <typename Value>
BondForce<Value> bond_force(const BondShape& bond, const Value& pair, const Value& q_sum, const Value& b_sum,
                            const Value& shear_mean, const Value& curvature_difference,
                            const Value& shear_difference) {
  const Value force = pair * shear_mean * shear_difference;
  return {force, pair * (q_sum + 2 * b_sum * curvature_difference) + force * (bond.length / 2)};
}

/// Energy that point k books for the bond, per A_k (the sums of Eqs. 1 and 2): omega V_j (b s^2 + C gamma^2 / 4) xi^2.
inline double bond_energy(const BondShape& bond, double area_j, double b, double shear, double curvature_difference,
                          double shear_difference) {
  return bond.weight * area_j *
         (b * curvature_difference * curvature_difference + shear / 4 * shear_difference * shear_difference);
}

}  // namespace plate
