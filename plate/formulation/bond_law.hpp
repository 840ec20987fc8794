#pragma once

/// Constitutive law of one bond: the formulas of theory.md, "Bond law" (Dai 1-13), written per pair of points with
/// areas A_k, A_j. `Value` is a number, or an array of numbers for as many pairs at once.
namespace plate {

/// Geometry of a bond k -> j. The rotation along the bond is n . psi = m . theta with psi = (-theta_y, theta_x)
/// and m = (n_y, -n_x).
struct BondShape {
  double mx, my;  // m
  double length;  // xi [length]
  double weight;  // omega(xi) beta h [length]; times A_j: omega V_j
};

/// End of a bond.
template <typename Value = double>
struct Kinematics {
  Value w, theta_x, theta_y;
};

/// s xi = n . (psi_j - psi_k): bond curvature times length (Dai 3). `bond` has mx, my and length as in BondShape.
template <typename Bond, typename Value>
Value curvature_difference(const Bond& bond, const Kinematics<Value>& k, const Kinematics<Value>& j) {
  return bond.mx * (j.theta_x - k.theta_x) + bond.my * (j.theta_y - k.theta_y);
}

/// gamma xi: bond shear angle times length (the bracket of Dai 2).
template <typename Bond, typename Value>
Value shear_difference(const Bond& bond, const Kinematics<Value>& k, const Kinematics<Value>& j) {
  return j.w - k.w - bond.length / 2 * (bond.mx * (k.theta_x + j.theta_x) + bond.my * (k.theta_y + j.theta_y));
}

/// Force on w and couple along m on point k; theta gets m * couple.
template <typename Value>
struct BondForce {
  Value force, couple;
};

/// Force of a bond on point k (Dai 11-13, with what each end gives to the bond): q = 2 A a theta of the points,
/// D the weight of the bond in the theta of either, curvature = 2 (A_k B_kj + A_j B_jk), shear = 2 (A_k S_kj + A_j
/// S_jk).
template <typename Value, typename Number>
BondForce<Value> bond_force(const Number& length, const Number& D_kj, const Number& D_jk, const Number& curvature,
                            const Number& shear, const Value& q_k, const Value& q_j, const Value& curvature_difference,
                            const Value& shear_difference) {
  const Value force = shear * shear_difference;
  return {force, D_kj * q_k + D_jk * q_j + curvature * curvature_difference + force * (length / 2)};
}

/// Energy of the bond that is assigned to point k, per A_k: B (s xi)^2 + S (gamma xi)^2.
inline double bond_energy(double B, double S, double curvature_difference, double shear_difference) {
  return B * curvature_difference * curvature_difference + S * shear_difference * shear_difference;
}

}  // namespace plate
