#pragma once

#include "geometry/shape/crack_path.hpp"
#include "plate/bonds/family_operator.hpp"
#include "plate/bonds/supports.hpp"

/// Plates small enough for dense matrices.
namespace small_plate {

inline const plate::Section section{1000, 0.3, 0.25, 5.0 / 6, 2};

/// One plate with everything that the solvers need.
struct Model {
  geometry::Outline outline, cells;  // [length], in lattice units
  plate::Discretization discretization;
  plate::Boundary boundary;
  plate::FamilyOperator plate;

  Eigen::Index points() const { return static_cast<Eigen::Index>(plate.points()); }
};

plate::HorizonWeights horizon_weights(const geometry::Families& families, const std::vector<plate::BondShape>& shapes,
                                      const plate::Boundary& boundary, const plate::Discretization& d,
                                      plate::PlateLaw law = plate::PlateLaw::bending);

/// `cracks` in lattice units; without mirror images of the cracks.
Model model(const geometry::Outline& outline, const std::vector<plate::Support>& supports,
            const plate::Discretization& d, const std::vector<geometry::CrackPath>& cracks = {},
            plate::PlateLaw law = plate::PlateLaw::bending);

plate::Discretization spaced(double spacing);

plate::State random_state(Eigen::Index points, unsigned seed);

/// K of all degrees of freedom, column by column: forces = -K state.
Eigen::MatrixXd stiffness(const plate::FamilyOperator& op);

/// P of u = P q, one column for every free degree of freedom, from the lists of the constraints.
Eigen::MatrixXd prolongation(const plate::Constraints& constraints, Eigen::Index dofs);

}  // namespace small_plate
