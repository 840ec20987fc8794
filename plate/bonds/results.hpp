#pragma once
#include "geometry/lattice/cloud.hpp"
#include "geometry/lattice/families.hpp"
#include "plate/formulation/bond_law.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/mesh.hpp"
#include "plate/formulation/sections.hpp"
#include "plate/formulation/tip_view.hpp"
#include "plate/model/numerical_method.hpp"
#include "plate/model/state.hpp"

namespace plate {

/// The points of the plate, squares between them, and triangles up to edges, holes and cracks (geometry::drawn_cells).
/// `cracks` [length]. Points alone where edges and cracks are too close to each other for cells.
Mesh mesh(const Boundary& boundary, const geometry::Outline& outline, const std::vector<geometry::CrackPath>& cracks,
          std::vector<double> cut, double thickness);

/// Gradients by weighted least squares over the family of k (theory (43)); `state` includes fictitious points.
Gradients gradients(std::size_t k, const State& state, const geometry::Families& families,
                    const std::vector<BondShape>& shapes, const std::vector<double>& areas);

/// Resultants at the first `plate_points` points from weighted least-squares gradients over each family: curvatures
/// from the differences of the rotations, shear angles from the bond shear (exact for quadratic w with linear
/// rotations, so that thin plates show no spurious shear). `state` includes fictitious points.
Resultants resultants(const State& state, const geometry::Families& families, const std::vector<BondShape>& shapes,
                      const std::vector<double>& areas, std::size_t plate_points, const Section& section);

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
