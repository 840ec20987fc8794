#pragma once
#include <span>

#include "plate/bonds/family_operator.hpp"
#include "plate/formulation/boundary.hpp"

namespace fracture {

/// What a family's bonds do against rotations and deflections of its point alone, over its area.
double bending_stiffness(double a, std::span<const plate::BondWeights> bonds);
double shear_stiffness(std::span<const plate::BondWeights> bonds);

/// What no family that lost bonds exceeds, and none of its bonds.
struct Stiffest {
  double bending = 0, shear = 0;
  std::vector<plate::BondWeights> bonds;  // B and S by bond vector; infinite for those of no full family
};

/// Of the first full family of the plate, of whichever process.
Stiffest stiffest(const plate::FamilyOperator& plate, const plate::Boundary& boundary);

}  // namespace fracture
