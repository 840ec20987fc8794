#pragma once
#include "plate/bonds/family_operator.hpp"
#include "plate/solve/stretching.hpp"

namespace plate {

/// The plate of bonds in its plane under large deflections (theory.md, "Large deflections" of bonds): the elongation of
/// every bond has half the square of the difference of its deflections over its length beside that of u and v. Bonds to
/// points beyond edges take the deflections of the plate's images there.
class BondStretching : public Stretching {
public:
  /// `plate`: in its plane (PlateLaw::membrane); `section` likewise. Both and `areas` must outlive this.
  BondStretching(const FamilyOperator& plate, const Section& section, const std::vector<double>& areas,
                 std::size_t plate_points)
      : plate_(plate), section_(section), areas_(areas), plate_points_(plate_points) {}

  Eigen::VectorXd energies(const State& bending, const State& membrane) const override;
  void internal_force(const State& bending, const State& membrane, Forces& on_bending,
                      Forces& on_membrane) const override;
  PointMatrix stiffness(const State& bending, const State& membrane) const override;
  PointMatrix geometric_stiffness(const State& membrane) const override;
  PointMatrix stiffness_of_heat(const Eigen::VectorXd& free) const override;
  Stretch stretch(const State& bending) const override;
  Eigen::Matrix3Xd membrane_forces(const State& bending, const State& membrane) const override;

private:
  PointMatrix between_deflections() const;
  Eigen::Matrix3Xd strains(const State& bending) const;

  const FamilyOperator& plate_;
  const Section& section_;
  const std::vector<double>& areas_;
  std::size_t plate_points_;
};

}  // namespace plate
