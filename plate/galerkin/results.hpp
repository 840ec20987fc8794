#pragma once
#include "plate/formulation/sections.hpp"
#include "plate/formulation/tip_view.hpp"
#include "plate/galerkin/families.hpp"

namespace plate {

struct Problem;

/// Resultants from the mean strains of the Galerkin plate's families; shear forces with its shear scaling, which they
/// contain.
Resultants resultants(const State& state, const GalerkinFamilies& families, const PointSections& sections);

/// The Galerkin plate: gradients of its families, virtual crack extension by moving its points.
class GalerkinView : public TipView {
public:
  /// `seen`: geometry::positions_inside_faces() of the cells.
  GalerkinView(const geometry::Tessellation& cells, const GalerkinFamilies& galerkin,
               const std::vector<geometry::Point>& seen, const std::vector<BondShape>& shapes, const Problem& problem,
               const PointSections& sections);

  Gradients gradients(std::uint32_t k, const State& state) const override;
  GradientShares gradient_shares(std::uint32_t k) const override;
  geometry::Point extension_slope(std::uint32_t k, const TipFrame& frame, const Ring& ring) const override;
  Eigen::Matrix2d shear_stiffness(std::uint32_t k) const override;
  std::unique_ptr<EnergyRelease> virtual_extension(const TipFrame& frame, const Ring& ring) const override;

private:
  const geometry::Tessellation& cells_;
  const GalerkinFamilies& galerkin_;
  const PointSections& sections_;
};

}  // namespace plate
