#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>

#include "plate/formulation/sections.hpp"
#include "plate/galerkin/families.hpp"
#include "plate/galerkin/operator.hpp"
#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {

/// K of one family after the other: second derivatives of its energy by the degrees of freedom of its owner and of its
/// members. Parts of low rank, from the mean strains, and one part for each bond (theory.md, "The Galerkin plate").
class FamilyStiffness {
public:
  static constexpr std::size_t most_members = 33;  // with the owner

  /// Constructs from families and sections; both must outlive this. `residual`: t_b where it is not that of the
  /// sections.
  FamilyStiffness(const GalerkinFamilies& families, const PointSections& sections, std::optional<double> residual = {})
      : families_(families), sections_(sections), residual_of_all_(residual) {}
  FamilyStiffness(const GalerkinFamilies& families, PointSections&& sections) = delete;

  /// Throws std::invalid_argument where k has more than 32 neighbours.
  void find(std::size_t k);

  /// Number of members of the family of the last find(): its owner and its neighbours.
  std::size_t members() const { return members_; }

  /// K_ij of members i and j, in the order of the family; 0: the owner.
  Eigen::Matrix3d block(std::size_t i, std::size_t j) const {
    Eigen::Matrix3d result;
    for (std::size_t c = 0; c < 9; ++c) result.data()[c] = blocks_[(i * 9 + c) * stride + j];
    return result;
  }

private:
  static constexpr std::size_t stride = 40;  // whole machine vectors of members
  using Numbers = std::array<double, stride>;

  void take_bonds(std::size_t k, const GalerkinStiffness& stiffness);
  void add_bonds();
  void find_rows(std::size_t i);

  const GalerkinFamilies& families_;
  const PointSections& sections_;
  std::optional<double> residual_of_all_;  // t_b
  std::size_t members_ = 0;
  // of every bond: x_i - x_k, 1 / length, share; by members, the owner's unused
  Numbers x_, y_, inverse_, share_;
  // mean strains of every member per degree of freedom, and half of the forces that belong to them. H_ab = sum psi_a
  // G_b.
  std::array<Numbers, 2> G_;
  std::array<Numbers, 4> residual_;                       // share / length^2 of t_b B xx, xy, yy and of t_s e n S n
  std::array<Numbers, 8> moments_;                        // half the derivative by H_ab, of psi_c: 4 a + 2 b + c
  std::array<Numbers, 6> gamma_, forces_;                 // 3 a + degree of freedom
  std::array<double, stride * 9 * most_members> blocks_;  // by member i, component 3 d + c of K_ij(c, d), member j
};

/// K of one family as a dense matrix, three rows for the owner and for every member, in the order of the family.
Eigen::MatrixXd family_stiffness(const GalerkinFamilies& families, const PointSections& sections, std::size_t k);

/// K of all degrees of freedom. Any number of threads gives the same bits.
PointMatrix stiffness_matrix(const GalerkinOperator& plate);

/// Stiffness without the elastic supports. `residual`: as FamilyStiffness.
PointMatrix stiffness_matrix(const GalerkinFamilies& families, const PointSections& sections,
                             std::optional<double> residual = {});

/// The coupling of a section that couples: B in the place of D, and t_c such that the energy of bending, stretching and
/// coupling is positive.
struct GalerkinCoupling {
  PointSections sections;
  double residual;
};
/// `section`: of the plate, the same everywhere, of any law.
GalerkinCoupling galerkin_coupling(const GalerkinFamilies& families, const Section& section);

/// Derivatives of the energy by the rotations of a plate and by the displacements in its plane, symmetric
/// (theory.md, "Coupled sections"). `section`: of the plate that bends, the same everywhere.
PointMatrix coupling_matrix(const GalerkinFamilies& families, const Section& section);

}  // namespace plate
