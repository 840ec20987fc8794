#pragma once
#include "fracture/growth/criteria.hpp"
#include "plate/bonds/parameters/family_rule.hpp"

namespace fracture {

/// Largest energy release rate that a crack needs for steady growth under a criterion for bonds, over the fracture
/// energy that the criterion was made for: measured, theory.md, "Apparent toughness".
double apparent_toughness(Growth::Criterion criterion, double thickness, const plate::Discretization& discretization);

/// What the bonds of a plate bear (theory.md, "Bonds that break").
class BondLimits {
public:
  BondLimits(const Growth& growth, const plate::Section& section, const plate::Discretization& discretization);

  /// Of a bond with this energy, curvature and shear angle (both times its length): below 1 it holds. Quadratic in the
  /// state. `weight`: omega beta h A_j of either end, times A_k [length^5].
  double demand(double energy, double curvature_difference, double shear_difference, double length,
                double weight) const;
  /// Curvature [1/length] and shear angle that no bond bears if all its neighbours have it too: of full families.
  double curvature() const { return curvature_; }
  double shear() const { return shear_; }
  /// Energy that bonds across a unit of crack bear, over the weight of a bond; 0 where energies are not limited.
  double energy() const { return energy_; }

private:
  bool tension_only_, by_energy_;
  double energy_ = 0, curvature_, shear_;
};

}  // namespace fracture
