#pragma once
#include "fracture/breakage/damaged_plate.hpp"
#include "fracture/growth/growth.hpp"
#include "plate/bonds/family_weights.hpp"

namespace fracture {

class PointNumbers;

/// Largest energy release rate that a crack needs for steady growth under a criterion for bonds, over the fracture
/// energy that the criterion was made for: measured, theory.md, "Apparent toughness".
double apparent_toughness(Growth::Criterion criterion, double thickness, const plate::Discretization& discretization);

/// Failure limits of the bonds of a plate (theory.md, "Bonds that break").
class BondLimits {
public:
  BondLimits(const Growth& growth, const plate::Section& section, const plate::Discretization& discretization);

  /// Demand on a bond with this energy, curvature and shear angle (both times its length): below 1 it holds. Quadratic
  /// in the state. `weight`: omega beta h A_j of either end, times A_k [length^5].
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

/// A bond and its demand (BondLimits). Its ends as PointNumbers has them.
struct LoadedBond {
  PointPair bond;
  double demand;
};

/// Looks for the bonds that fail. Only bonds between points of the plate break: supports hold what they hold. One call
/// at a time; where the plate is distributed, all call it at once and get the bonds of all.
class BondCheck {
public:
  /// Constructs a check of bonds; all arguments must outlive this.
  BondCheck(const Growth& growth, const BondLimits& limits, const DamagedPlate& plate, const plate::Boundary& boundary);

  /// Intact bonds of the plate, or of these points of it (ascending, as suspects() has found them), with a demand of at
  /// least `least`: largest first, equal ones by their points.
  std::vector<LoadedBond> at_least(double least, const plate::State& state) { return at_least(least, state, all_); }
  std::vector<LoadedBond> at_least(double least, const plate::State& state, const std::vector<std::uint32_t>& points);
  /// The largest demand of the plate.
  double largest(const plate::State& state);

  /// Points within a horizon of bonds whose curvature or shear is a share of 0.25 of the limit at least, squared, among
  /// those between nearest neighbours and all of points with broken bonds. Bonds elsewhere bear a multiple of what they
  /// have.
  std::vector<std::uint32_t> suspects(const plate::State& state) const;

  /// Numbers of suspects of all processes, ascending; and those of them that this one looks at.
  std::vector<std::uint32_t> numbers(const std::vector<std::uint32_t>& suspects) const;
  std::vector<std::uint32_t> points(const std::vector<std::uint32_t>& numbers) const;

  /// Returns the bonds by the points of this rank; `outside_overlap` for points that it does not know.
  std::vector<PointPair> here(const std::vector<LoadedBond>& bonds) const;

private:
  /// Points whose families are looked at for suspects.
  const std::vector<std::uint32_t>& around() const { return around_.empty() ? all_ : around_; }
  bool may_break(std::uint32_t k, std::size_t i, std::uint32_t j) const;
  double demand(std::uint32_t k, std::size_t i, const plate::State& state) const;
  void find_dilatations(const plate::State& state, const std::vector<std::uint32_t>& points);

  const Growth& growth_;
  const BondLimits& limits_;
  const DamagedPlate& plate_;
  const plate::Boundary& boundary_;
  std::shared_ptr<const PointNumbers> numbers_;
  std::vector<std::uint32_t> all_;     // where the plate is distributed: owned points, and what these have bonds to
  std::vector<std::uint32_t> around_;  // and what those have bonds to
  std::vector<std::vector<std::uint32_t>> nearest_;  // per pattern of the base: which bonds are a spacing long
  std::vector<double> dilatation_;                   // per point
  std::vector<char> marked_;                         // per point, zero between calls
};

}  // namespace fracture
