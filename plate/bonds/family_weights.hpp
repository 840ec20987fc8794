#pragma once
#include <span>

#include "plate/bonds/horizon_parameters.hpp"
#include "plate/formulation/bond_law.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/state.hpp"

/// Position-aware surface correction: the plate's counterpart of the position-aware linear solid (Mitchell, Silling,
/// Littlewood 2015, "A position-aware linear solid constitutive model for peridynamics").
namespace plate {

/// A bond as the correction sees it.
struct FamilyBond {
  geometry::Point vector;  // x_j - x_k [length]
  double weight;           // omega A_j [length^3]
};

/// Quality with which the weights of a family could be matched.
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

/// Parameters of a point from the sums over its family, by any of the corrections that Dai et al. compare; of
/// position-aware plates those of the arbitrary horizon domain. A family without bonds gets zeros.
class ParameterRule {
public:
  ParameterRule(const Section& section, const Discretization& discretization);
  PointParameters operator()(const FamilySums& sums) const;

private:
  Section section_;
  SurfaceCorrection correction_;
  TwistMatch match_;
  FamilySums full_;  // of a full family of the lattice
  PointParameters constant_;
};

/// Weights of one family by the surface correction of a plate: what a point gets anew where it loses bonds.
class FamilyRule {
public:
  FamilyRule(const Section& section, const Discretization& discretization);
  FamilyWeights operator()(std::span<const FamilyBond> bonds) const;

  const Section& section() const { return section_; }
  const Discretization& discretization() const { return discretization_; }

private:
  Section section_;
  Discretization discretization_;
  ParameterRule parameters_;
};

/// A bond of a family that is kept for itself.
struct OwnBond {
  std::uint32_t neighbour;
  double mx, my, length;  // as in BondShape
  BondWeights weights;
};

/// The family of one point with its own weights: what its point stores (theory (12)).
struct OwnFamily {
  std::uint32_t point = 0;
  double area = 0;  // [length^2]
  double a = 0;     // [force length]
  std::vector<OwnBond> bonds;
};

/// Energy that the point stores, A W, as the bilinear form of two states; of one state given twice it is its energy.
double energy(const OwnFamily& family, const State& a, const State& b);

/// Adds `share` times the forces of that energy, -dU/d(state), to the point and its neighbours.
void add_force(const OwnFamily& family, const State& state, double share, Forces& forces);

}  // namespace plate
