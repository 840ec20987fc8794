#pragma once
#include "tests/verification/galerkin/systems.hpp"

/// Plane strain elasticity of the same systems, as in the thesis; degrees of freedom (u_x, u_y) of point k at 2 k.
namespace galerkin_systems {

struct Solid {
  double young, poisson;

  double lambda() const { return young * poisson / ((1 + poisson) * (1 - 2 * poisson)); }
  double mu() const { return young / (2 * (1 + poisson)); }
  double bulk() const { return lambda() + 2 * mu() / 3; }

  /// P of a displacement gradient.
  Eigen::Matrix2d stress(const Eigen::Matrix2d& H) const {
    return mu() * (H + H.transpose()) + lambda() * H.trace() * Eigen::Matrix2d::Identity();
  }
};

/// Stresses of strains xx, yy, 2 xy: all of them, and those of the energy mu (eps:eps - tr^2 eps / 3) of the distortion
/// that Bode 2.43 splits off.
Eigen::Matrix3d law(const Solid& solid);
Eigen::Matrix3d isochoric_law(const Solid& solid);

/// Strains xx, yy, 2 xy of gradients per node, 3 x 2 nodes.
Eigen::MatrixXd strain(const Eigen::Matrix2Xd& gradient);

/// Bubnov-Galerkin: the sum of squares of a system's samples.
Eigen::MatrixXd plane_stiffness(const Solid& solid, const Body& b, const System& system);

/// One family's share of it, on the degrees of freedom of its nodes.
Eigen::MatrixXd family_stiffness(const Solid& solid, const Family& family);

/// Petrov-Galerkin, unsymmetric: PPG1 (Bode 4.21) V_k P^ik . G^k_i on the difference of test displacements at i and k,
/// PPG2 (Bode 4.22) V_i P^ki . G^k_i. `trial` has a sample per node of each family, `test` one at each master.
enum class Petrov { first, second };
Eigen::MatrixXd petrov_stiffness(const Eigen::Matrix3d& law, const Body& b, const System& trial, const System& test,
                                 Petrov kind);

/// Constant-plus-linear correction V1 of a test system for PPG2: Bode 5.17 and 5.25 hold for every family.
System second_order_consistent(const Body& b, System test);

/// A displacement field with its gradient.
struct Field {
  std::function<Eigen::Vector2d(const Eigen::Vector2d&)> value;
  std::function<Eigen::Matrix2d(const Eigen::Vector2d&)> gradient;
};

struct Norms {
  double L2, H1;  ///< of the error, Bode 7.3
};

/// The thesis' patch test: displacements of the field on left, bottom and right, its tractions on top, body force b0.
Norms patch_norms(const Solid& solid, const Body& b, const Eigen::MatrixXd& K, const Eigen::Matrix2Xd& normals,
                  const Field& field, const Eigen::Vector2d& b0);

}  // namespace galerkin_systems
