#pragma once
#include "plate/bonds/parameters/position_aware.hpp"

namespace plate {

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

}  // namespace plate
