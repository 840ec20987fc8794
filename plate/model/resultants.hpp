#pragma once
#include "geometry/lattice/families.hpp"
#include "plate/bonds/law.hpp"
#include "plate/galerkin/law.hpp"

namespace plate {

/// Section forces per length and the equivalent stress at z = +h/2. M > 0 is tension on the z > 0 face.
struct Resultants {
  Eigen::Matrix3Xd moments;    // Mxx, Myy, Mxy [force]
  Eigen::Matrix2Xd shear;      // Qx, Qy [force/length]
  Eigen::VectorXd von_mises;   // [force/length^2]
};

/// Gradients at a point.
struct Gradients {
  Eigen::Matrix2d theta = Eigen::Matrix2d::Zero();  // row: theta_x, theta_y; column: d/dx, d/dy
  Eigen::Vector2d shear = Eigen::Vector2d::Zero();  // gamma_xz, gamma_yz
};

/// By weighted least squares over the family of k (theory.md, Eq. 32); `state` includes fictitious points.
Gradients gradients(std::size_t k, const State& state, const geometry::Families& families,
                    const std::vector<BondShape>& shapes, const std::vector<double>& areas);

/// Resultants at the first `plate_points` points from weighted least-squares gradients over each family: curvatures
/// from the differences of the rotations, shear angles from the bond shear (exact for quadratic w with linear
/// rotations, so that thin plates show no spurious shear). `state` includes fictitious points.
Resultants resultants(const State& state, const geometry::Families& families, const std::vector<BondShape>& shapes,
                      const std::vector<double>& areas, std::size_t plate_points, const Section& section);

/// The same from the mean strains of the Galerkin plate's families; shear forces with its shear scaling, which they
/// contain.
Resultants resultants(const State& state, const GalerkinFamilies& families, const Section& section);

}  // namespace plate
