#pragma once
#include <span>
#include "plate/bonds/parameters/weights.hpp"
#include "plate/formulation/formulation.hpp"

/// Position-aware surface correction: the plate's counterpart of the position-aware linear solid (Mitchell, Silling,
/// Littlewood 2015, "A position-aware linear solid constitutive model for peridynamics").
namespace plate {

/// A bond as the correction sees it.
struct FamilyBond {
  geometry::Point vector;  // x_j - x_k [length]
  double weight;           // omega A_j [length^3]
};

/// How well the weights of a family could be matched.
enum class Match {
  exact,             // the energy of every constant curvature and every constant shear
  blended,           // an exact weight would be negative or next to nothing: mixed with the arbitrary horizon's
  arbitrary_horizon  // too few directions: the arbitrary horizon's weights
};

struct FamilyWeights {
  double a = 0;
  std::vector<BondWeights> bonds;
  Match match = Match::exact;
};

/// Weights omega A_j times a polynomial of the direction, changed as little as possible (least squares, weighted with
/// omega A_j xi^2) from those of a full family, so that constant curvature and constant shear have the plate's energy
/// with the bonds at hand (theory (12, 13)).
FamilyWeights position_aware(const Section& section, std::span<const FamilyBond> bonds);

struct PositionAware {
  HorizonWeights weights;
  MatchCounts counts;
};

PositionAware position_aware(const geometry::Families& families, const std::vector<BondShape>& shapes,
                             const std::vector<double>& areas, const std::vector<char>& active,
                             const FamilyKinds& kinds, const Section& section);

}  // namespace plate
