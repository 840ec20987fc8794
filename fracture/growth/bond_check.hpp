#pragma once
#include "fracture/growth/bond_limits.hpp"
#include "fracture/severing/severed_plate.hpp"

namespace fracture {

class PointNumbers;

/// A bond and its demand (BondLimits). Its ends as PointNumbers has them.
struct LoadedBond {
  PointPair bond;
  double demand;
};

/// Looks for the bonds that fail. Only bonds between points of the plate break: supports hold what they hold. One call
/// at a time; where processes share the plate, all call it at once and get the bonds of all.
class BondCheck {
public:
  /// All must outlive this.
  BondCheck(const Growth& growth, const BondLimits& limits, const SeveredPlate& plate, const plate::Boundary& boundary);

  /// Intact bonds of the plate, or of these points of it (ascending, as suspects() has found them), with a demand of at
  /// least `least`: largest first, equal ones by their points.
  std::vector<LoadedBond> at_least(double least, const plate::State& state);
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

  /// As this process has them; `unseen` where it does not.
  std::vector<PointPair> here(const std::vector<LoadedBond>& bonds) const;

private:
  /// Points whose families are looked at for suspects.
  const std::vector<std::uint32_t>& around() const { return around_.empty() ? all_ : around_; }
  bool may_break(std::uint32_t k, std::size_t i, std::uint32_t j) const;
  double demand(std::uint32_t k, std::size_t i, const plate::State& state) const;
  void find_dilatations(const plate::State& state, const std::vector<std::uint32_t>& points);

  const Growth& growth_;
  const BondLimits& limits_;
  const SeveredPlate& plate_;
  const plate::Boundary& boundary_;
  std::shared_ptr<const PointNumbers> numbers_;
  std::vector<std::uint32_t> all_;     // where processes share the plate: own points, and what these have bonds to
  std::vector<std::uint32_t> around_;  // and what those have bonds to
  std::vector<std::vector<std::uint32_t>> nearest_;  // per pattern of the base: which bonds are a spacing long
  std::vector<double> dilatation_;                   // per point
  std::vector<char> marked_;                         // per point, zero between calls
};

}  // namespace fracture
