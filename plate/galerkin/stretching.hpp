#pragma once
#include "plate/formulation/sections.hpp"
#include "plate/galerkin/families.hpp"
#include "plate/galerkin/stiffness.hpp"
#include "plate/solve/stretching.hpp"

namespace plate {

/// The Galerkin plate in its plane under large deflections (theory.md, "Large deflections"): mean strains of every
/// family with the square of its mean slope, and residuals of its bonds with the square of their own. In a section that
/// couples, curvatures act on these strains (theory.md, "Coupled sections"): what the plate does to its plane, and the
/// plane to the plate, is among energies, forces and stiffness then.
class GalerkinStretching : public Stretching {
public:
  /// `sections`: of the plate in its plane. Both must outlive this. `coupling`: of a section that couples.
  GalerkinStretching(const GalerkinFamilies& families, const PointSections& sections,
                     std::optional<GalerkinCoupling> coupling = {})
      : families_(families), sections_(sections), coupling_(std::move(coupling)) {}

  Eigen::VectorXd energies(const State& bending, const State& membrane) const override;
  void internal_force(const State& bending, const State& membrane, Forces& on_bending,
                      Forces& on_membrane) const override;
  PointMatrix stiffness(const State& bending, const State& membrane) const override;
  PointMatrix geometric_stiffness(const State& membrane) const override;
  PointMatrix stiffness_of_forces(const Eigen::Matrix3Xd& forces) const override;
  Stretch stretch(const State& bending) const override;
  Eigen::Matrix3Xd membrane_forces(const State& bending, const State& membrane) const override;
  PointMatrix stiffness_of_heat(const Eigen::VectorXd& free) const override;

private:
  const GalerkinFamilies& families_;
  const PointSections& sections_;
  std::optional<GalerkinCoupling> coupling_;

  const GalerkinCoupling* coupling() const { return coupling_ ? &*coupling_ : nullptr; }
};

}  // namespace plate
