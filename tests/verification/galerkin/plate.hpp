#pragma once
#include "cases/papers/bodies/galerkin/systems.hpp"

/// A Mindlin plate of those systems; degrees of freedom (w, psi_x, psi_y) of point k at 3 k.
namespace galerkin_systems {

struct Plate {
  double young = 1000, poisson = 0.3, thickness = 0.1, shear_correction = 5.0 / 6, density = 1;

  double D() const { return young * thickness * thickness * thickness / (12 * (1 - poisson * poisson)); }
  double kG() const { return shear_correction * young / (2 * (1 + poisson)) * thickness; }
};

/// bond: gamma = sum_i G_i s_ki with s_ki = w_i - w_k - X.(psi_i + psi_k) / 2; direct: grad w - psi at the sample.
/// Assumed: constant in each family, the plate's counterpart of UnlP0 (Bode 6.9); condensed, the samples' weighted
/// mean. Along: at a bond's sample the bond's own shear along it, the family's mean across it.
enum class Shear { bond, direct, assumed_bond, assumed_direct, assumed_along };

Sparse stiffness(const Plate& plate, const System& system, const Body& b, Shear shear = Shear::bond);

/// rho h V_k, rho h^3/12 V_k.
Eigen::VectorXd lumped_mass(const Plate& plate, const Body& b);

/// Constant M and Q on the outline, and the body couple Q that balances Q. Q brings end couples q l^2 / 12.
Eigen::VectorXd patch_load(const Body& b, const Eigen::Matrix2d& M, const Eigen::Vector2d& Q);

/// All angular frequencies squared of K u = omega^2 M u, ascending; dense.
Eigen::VectorXd all_frequencies(const Sparse& K, const Eigen::VectorXd& mass);

/// The lowest `count` of them, by subspace iteration on K + shift M.
Eigen::VectorXd lowest_frequencies(const Sparse& K, const Eigen::VectorXd& mass, int count);

/// Support of the edges of a square; simply: w and the rotation along the edge (hard).
enum class Held { free, simply, clamped };

/// w at the middle point of a held body under unit pressure.
double centre_deflection(const Body& b, const Sparse& K, Held held);

/// Polynomial Ritz solutions of the Mindlin square of side 1: the reference that knows no points.
Eigen::VectorXd ritz_frequencies(const Plate& plate, int degree);   ///< free, squared, ascending
double ritz_deflection(const Plate& plate, Held held, int degree);  ///< at the centre under unit pressure

}  // namespace galerkin_systems
