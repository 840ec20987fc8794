#pragma once
#include "cases/papers/bodies/galerkin/systems.hpp"

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

/// Degrees of freedom of nodes, in their order.
std::vector<int> unknowns(const Nodes& nodes);

/// Stresses of strains xx, yy, 2 xy: all of them, and those of the energy mu (eps:eps - tr^2 eps / 3) of the distortion
/// that Bode 2.43 splits off.
Eigen::Matrix3d law(const Solid& solid);
Eigen::Matrix3d isochoric_law(const Solid& solid);

/// Appends an entry for each pair of a row and a column of a small matrix.
using Triplets = std::vector<Eigen::Triplet<double>>;
void add_block(Triplets& list, const Eigen::MatrixXd& values, const std::vector<int>& rows,
               const std::vector<int>& columns);

Sparse sparse(const Triplets& entries, Eigen::Index rows, Eigen::Index columns);

/// Strains xx, yy, 2 xy of gradients per node, 3 x 2 nodes.
Eigen::MatrixXd strain(const Eigen::Matrix2Xd& gradient);

/// Bubnov-Galerkin: the sum of squares of a system's samples.
Sparse plane_stiffness(const Solid& solid, const Body& b, const System& system);

/// One family's share of it, on the degrees of freedom of its nodes.
Eigen::MatrixXd family_stiffness(const Solid& solid, const Family& family);

/// Petrov-Galerkin, unsymmetric: PPG1 (Bode 4.21) V_k P^ik . G^k_i on the difference of test displacements at i and k,
/// PPG2 (Bode 4.22) V_i P^ki . G^k_i. `trial` has a sample per node of each family, `test` one at each master.
enum class Petrov { first, second };
Sparse petrov_stiffness(const Eigen::Matrix3d& law, const Body& b, const System& trial, const System& test,
                        Petrov kind);

/// Constant-plus-linear correction V1 of a test system for PPG2: Bode 5.17 and 5.25 hold for every family.
System second_order_consistent(const Body& b, System test);

/// A displacement field with its gradient.
struct Field {
  std::function<Eigen::Vector2d(const Eigen::Vector2d&)> value;
  std::function<Eigen::Matrix2d(const Eigen::Vector2d&)> gradient;
};

/// Bode 7.1, and 7.4 with its body force 7.6; the square [-1, 1]^2 of the thesis is moved to [0, 2]^2.
Field linear_field();
Field quadratic_field();
Eigen::Vector2d quadratic_body_force(const Solid& solid);

/// Bode 7.7 and its body force 7.8, moved as above.
Field manufactured_field();
Eigen::Vector2d manufactured_body_force(const Solid& solid, const Eigen::Vector2d& x);

struct Norms {
  double L2, H1;  ///< of the error, Bode 7.3
};

/// The thesis' patch test: displacements of the field on left, bottom and right, its tractions on top, body force b0.
Norms patch_norms(const Solid& solid, const Body& b, const Sparse& K, const Eigen::Matrix2Xd& normals,
                  const Field& field, const Eigen::Vector2d& b0);

/// Norms of the error of displacements whose gradients are read at the masters, by the first sample of each family.
Norms field_norms(const Body& b, const System& read, const Eigen::VectorXd& u, const Field& field);

/// u of the points, with u given where `prescribed` is a number (not NaN); K need not be symmetric.
Eigen::VectorXd solved_by_lu(const Sparse& K, const Eigen::VectorXd& f, const Eigen::VectorXd& prescribed);

}  // namespace galerkin_systems
