#pragma once
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/tip_view.hpp"
#include "plate/model/discretization.hpp"

namespace plate {

/// Bonds over a horizon: gradients by least squares over the nearest bonds, virtual crack extension by moving the bonds
/// of a ring and matching the position-aware weights again.
class BondView : public TipView {
public:
  /// `families`: those of the plate, or what is left of them.
  BondView(const geometry::Cloud& cloud, const geometry::Families& families, const std::vector<BondShape>& shapes,
           const Section& section, const Discretization& discretization);

  Gradients gradients(std::uint32_t k, const State& state) const override;
  GradientShares gradient_shares(std::uint32_t k) const override;
  geometry::Point extension_slope(std::uint32_t k, const TipFrame& frame, const Ring& ring) const override;
  Eigen::Matrix2d shear_stiffness(std::uint32_t k) const override;
  std::unique_ptr<EnergyRelease> virtual_extension(const TipFrame& frame, const Ring& ring) const override;
};

}  // namespace plate
