#pragma once
#include "plate/galerkin/families.hpp"
#include "plate/model/section.hpp"
#include "plate/model/state.hpp"

/// One family of the Galerkin plate (theory.md, "The Galerkin plate"); psi = (-theta_y, theta_x).
namespace plate {

/// Weights of the parts of its energy.
struct GalerkinWeights {
  double bending_residual = 0.5;  // t_b, of the bending residuals of bonds
  double shear_residual = 1;      // t_s, of their shear residuals
  double shear_scaling =
      0.05;  // f = h^2 / (h^2 + this spacing^2): soft where points are wider apart than the plate is thick
  double residual_scaling = 1;  // e, in the same way
};

/// Stiffnesses of one family, by the square of the spacing about it.
struct GalerkinStiffness {
  Eigen::Matrix3d bending;                // of kappa xx, yy, 2 xy
  Eigen::Matrix2d shear, shear_residual;  // f S, t_s e S
  double bending_residual;                // t_b, of `bending`

  GalerkinStiffness(const LocalSection& section, double spacing_square, const GalerkinWeights& weights = {});
};

/// D by a bond along n: the energy of psi_a = r_a (n . x) is r . B r / 2.
inline Eigen::Matrix2d along(const Eigen::Matrix3d& bending, const geometry::Point& n) {
  Eigen::Matrix<double, 3, 2> strain;
  strain << n.x(), 0, 0, n.y(), n.y(), n.x();
  return strain.transpose() * bending * strain;
}

/// Gradient of the rotations H, psi_a,b in row a, column b [1 / length], and shear angles gamma of one point.
struct FamilyStrains {
  Eigen::Matrix2d psi = Eigen::Matrix2d::Zero();
  geometry::Point gamma{0, 0};
};

inline geometry::Point psi_of(const State& state, std::size_t k) {
  return {-state(2, Eigen::Index(k)), state(1, Eigen::Index(k))};
}

/// Bond shear angle times length: exact for quadratic deflections with linear rotations.
inline double bond_shear(const State& state, std::size_t k, std::size_t i, const geometry::Point& x) {
  return state(0, Eigen::Index(i)) - state(0, Eigen::Index(k)) - x.dot(psi_of(state, i) + psi_of(state, k)) / 2;
}

FamilyStrains family_strains(const GalerkinFamilies& families, std::size_t k, const State& state);

/// Energy of one family [force length].
double family_energy(const GalerkinFamilies& families, const LocalSection& section, std::size_t k, const State& state);

}  // namespace plate
