#pragma once
#include "plate/galerkin_rows.hpp"
#include "plate/operator.hpp"

namespace plate {

/// The Galerkin plate: nodal mean strains of the cells about every point, and residuals of its bonds (theory.md, "The
/// Galerkin plate"). Points inside the lattice by rows, all others by lists of their bonds.
/// Forces are gathered: any number of threads gives the same bits. One call at a time.
class GalerkinOperator : public Operator {
public:
  GalerkinOperator(GalerkinFamilies families, const Section& section);

  std::size_t points() const override { return families_.areas.size(); }
  void internal_force(const State& state, Forces& forces) const override;
  void absolute_product(const State& state, Forces& forces) const override;
  Forces diagonal() const override;

  /// Strain energy of every family [points].
  Eigen::VectorXd energies(const State& state) const;

  const GalerkinFamilies& families() const { return families_; }
  const Section& section() const { return section_; }
  std::size_t bytes() const;

private:
  /// Strains and stress resultants of one family, as its members need them.
  struct Resultants {
    Eigen::Matrix2d strain, moment;       // H; V M - sum t (x) n
    geometry::Point gamma, shear;         // gamma; V Q - sum tau n
  };
  /// A bond of a point i in no row, from both of its ends: i's family has it, and j's.
  struct Bond {
    std::uint32_t neighbour, family;      // j; place of j's family among those kept
    geometry::Point x;                    // x_j - x_i [length]
    geometry::Point own, others;          // G^i_j, G^j_i
    double own_bending, others_bending, own_shear, others_shear;  // c t_b D and c t_s e S of both, over the length
  };

  Resultants resultants(std::size_t k, const State& state) const;
  Eigen::Vector3d force(std::size_t i, const State& state) const;
  template <typename Local>
  void gather(const Local& local, Forces& result) const;

  GalerkinFamilies families_;
  Section section_;
  GalerkinRows rows_;
  std::vector<std::uint32_t> kept_;   // families of points in no row, and of their neighbours
  std::vector<std::uint32_t> place_;  // per point in no row: of its own family among those
  std::vector<std::size_t> first_;    // per point in no row: where its bonds begin
  std::vector<Bond> bonds_;
  Eigen::MatrixXd lattice_stiffness_;  // of a family of kind 0
  mutable std::vector<Resultants> resultants_;
};

}  // namespace plate
