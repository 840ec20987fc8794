#pragma once
#include <memory>
#include <optional>

#include "geometry/cells/tessellation.hpp"
#include "plate/model/section.hpp"
#include "plate/model/state.hpp"

namespace plate {

/// Weights of member i in the family of point k (theory (62-64)).
struct GalerkinBond {
  geometry::Point gradient;  // G^k_i, the mean over the cells about k of the gradient of i's hat function [1 / length]
  double share;              // c_ki: how much of k's area the residuals of the bond stand for [length^2]
};

/// Families of the points that share a cell, with the weights that make the plate variationally consistent: sums over
/// them obey Gauss's theorem. Points inside the lattice share their weights.
struct GalerkinFamilies {
  geometry::Families families;
  std::vector<double> areas;        // V_k [length^2]
  std::vector<std::uint32_t> kind;  // per point; 0: squares all about the point and its neighbours
  std::vector<std::size_t> first;   // per kind: where its bonds begin; size: kinds + 1
  std::vector<GalerkinBond> bonds;  // of every kind, in the order of the family
  double spacing_square = 0;        // [length^2]
  std::vector<double> own_square;   // where the distance of points varies: that of the spacing about each
  /// Families about one point of kind 0 of a distributed plate, whose weights all ranks take.
  std::shared_ptr<const GalerkinFamilies> of_all = {};
  std::uint32_t point_of_all = 0;

  /// Square of the spacing about a point, one for all points wherever that is possible: a shear scaling that varies
  /// would not pass constant shear.
  double square(std::size_t k) const { return own_square.empty() ? spacing_square : own_square[k]; }
  const GalerkinBond* of(std::size_t k) const { return bonds.data() + first[kind[k]]; }
};

GalerkinFamilies galerkin_families(const geometry::Tessellation& cells);
/// Families of a part of the cells of a plate. Inside the lattice, their weights equal those of `whole` to the last
/// bit.
GalerkinFamilies galerkin_families(const geometry::Tessellation& cells, const geometry::Tessellation& whole);

/// A point of kind 0, and the families that know it.
struct LatticeFamily {
  const GalerkinFamilies* families;
  std::uint32_t point;
};
/// The one whose weights all of kind 0 share; nothing where there is none.
std::optional<LatticeFamily> lattice_family(const GalerkinFamilies& families);

/// V_k alone.
std::vector<double> areas_of(const geometry::Tessellation& cells);

/// Returns the families of cells whose points have been moved: no two points share weights, squares need not be
/// squares.
GalerkinFamilies moved_galerkin_families(const geometry::Tessellation& cells);

/// Largest residuals, in spacings, of the two conditions of variational consistency (Bode 5.16
/// and 5.24): sum_k V_k G^k_i = A_i, the normals of the border at i, and sum_k V_k X_k (x) G^k_i = integral of x phi_i
/// n - V_i I. `own`: the points that are asked about; empty: all.
struct ConsistencyResiduals {
  double first = 0, second = 0;
};
ConsistencyResiduals consistency_residuals(const GalerkinFamilies& families, const geometry::Tessellation& cells,
                                           const std::vector<char>& own = {});

// Family of the Galerkin plate (theory.md, "The Galerkin plate"); psi = (-theta_y, theta_x).

/// Stiffnesses of one family, by the square of the spacing about it.
struct GalerkinStiffness {
  Eigen::Matrix3d bending;                // of kappa xx, yy, 2 xy
  Eigen::Matrix2d shear, shear_residual;  // f S, t_s e S: f and e soften it where points are wider apart than h
  double bending_residual;                // t_b, of `bending`

  GalerkinStiffness(const LocalSection& section, double spacing_square);
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
