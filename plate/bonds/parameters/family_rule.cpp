#include "plate/bonds/parameters/family_rule.hpp"

#include "plate/bonds/parameters/influence.hpp"

namespace plate {
namespace {

FamilySums full_sums(const Section& section, const Discretization& d) {
  FamilySums sums;
  const auto vectors = full_family(d);
  const auto shapes = bond_shapes(vectors, section, d);
  for (std::size_t i = 0; i < vectors.size(); ++i)
    add(sums, shapes[i], volume_share(d, vectors[i]), section.thickness, d.spacing * d.spacing);
  return sums;
}

PointParameters scaled(const PointParameters& p, double factor) {
  return {p.a, p.b * factor, p.d * factor, p.C * factor};
}

}  // namespace

ParameterRule::ParameterRule(const Section& section, const Discretization& d)
    : section_(section),
      correction_(d.surface_correction),
      match_(d.twist_match),
      full_(full_sums(section, d)),
      constant_(d.full_horizon == FullHorizon::lattice ? arbitrary_horizon(section, d.twist_match, full_, full_.twist)
                                                       : disc_parameters(section, d.influence, d.horizon())) {}

PointParameters ParameterRule::operator()(const FamilySums& sums) const {
  if (sums.second <= 0) return {};
  switch (correction_) {
    case SurfaceCorrection::none:
      return constant_;
    case SurfaceCorrection::volume:
      return scaled(constant_, full_.volume / sums.volume);
    case SurfaceCorrection::arbitrary_horizon:
    case SurfaceCorrection::position_aware:
      break;
  }
  return arbitrary_horizon(section_, match_, sums, full_.twist);
}

FamilyRule::FamilyRule(const Section& section, const Discretization& discretization)
    : section_(section), discretization_(discretization), parameters_(section, discretization) {}

FamilyWeights FamilyRule::operator()(std::span<const FamilyBond> bonds) const {
  if (discretization_.surface_correction == SurfaceCorrection::position_aware) return position_aware(section_, bonds);
  FamilySums sums;
  for (const auto& bond : bonds) {
    const double length = bond.vector.norm();
    const BondShape shape{bond.vector.y() / length, -bond.vector.x() / length, length, bond.weight};
    const double omega = influence(discretization_.influence, length, discretization_.horizon());
    add(sums, shape, bond.weight / (omega * section_.thickness), section_.thickness, 1);
  }
  const auto p = parameters_(sums);
  FamilyWeights result{p.a, {}, Match::exact};
  for (const auto& bond : bonds) result.bonds.push_back({p.d * bond.weight, p.b * bond.weight, p.C / 4 * bond.weight});
  return result;
}

}  // namespace plate
