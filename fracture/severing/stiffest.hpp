#pragma once
#include <span>

#include "fracture/severing/broken_bonds.hpp"
#include "plate/bonds/family_operator.hpp"
#include "plate/formulation/boundary.hpp"

namespace fracture {

/// What a family's bonds do against rotations and deflections of its point alone, over its area.
double bending_stiffness(double a, std::span<const plate::BondWeights> bonds);
double shear_stiffness(std::span<const plate::BondWeights> bonds);

/// Of the first full family of the plate, of whichever process.
Stiffest stiffest(const plate::FamilyOperator& plate, const plate::Boundary& boundary);

}  // namespace fracture
