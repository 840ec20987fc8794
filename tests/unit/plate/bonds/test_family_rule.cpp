#include "plate/bonds/family_weights.hpp"

#include "plate/bonds/horizon_parameters.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;
using small_plate::section;

namespace {

/// Bonds of a full family for which `keep` holds.
template <typename Keep>
std::vector<FamilyBond> kept_bonds(const Discretization& d, const Keep& keep) {
  std::vector<FamilyBond> result;
  const auto vectors = full_family(d);
  const auto shapes = bond_shapes(vectors, section, d);
  for (std::size_t i = 0; i < vectors.size(); ++i)
    if (keep(vectors[i])) result.push_back({vectors[i], shapes[i].weight * d.spacing * d.spacing});
  return result;
}

/// Energy per area of the same curvature in all directions (theory (12)).
double isotropic(const FamilyWeights& weights, const std::vector<FamilyBond>& family) {
  double dilatation = 0, sum = 0;
  for (std::size_t i = 0; i < family.size(); ++i) {
    const double length = family[i].vector.norm();
    dilatation += weights.bonds[i].D * length, sum += weights.bonds[i].B * length * length;
  }
  return weights.a * dilatation * dilatation + sum;
}

const double plate_energy = section.bending_stiffness() * (1 + section.poisson);

}  // namespace

TEST_CASE("family rule: a full family has the plate's energy, and so has what is left of one where the rule sees it") {
  using enum SurfaceCorrection;
  for (const auto correction : {none, volume, arbitrary_horizon, position_aware})
    for (const double spacing : {1.0, 0.01}) {
      auto d = small_plate::spaced(spacing);
      d.surface_correction = correction, d.full_horizon = FullHorizon::lattice;
      const FamilyRule rule(section, d);
      CAPTURE(int(correction), spacing);
      const auto full = kept_bonds(d, [](const auto&) { return true; });
      CHECK(isotropic(rule(full), full) == Approx(plate_energy).epsilon(1e-10));
      const auto half = kept_bonds(d, [](const auto& x) { return x.x() > -1e-12; });
      const auto oblique = kept_bonds(d, [](const auto& x) { return x.x() + 0.6 * x.y() > 0; });
      for (const auto& family : {half, oblique}) {
        const double share = isotropic(rule(family), family) / plate_energy;
        if (correction == none) CHECK(share < 0.75);
        if (correction == arbitrary_horizon || correction == position_aware) CHECK(share == Approx(1).epsilon(1e-10));
      }
    }
}

TEST_CASE("family rule: a family without bonds stores nothing") {
  using enum SurfaceCorrection;
  for (const auto correction : {none, volume, arbitrary_horizon, position_aware}) {
    auto d = small_plate::spaced(1);
    d.surface_correction = correction;
    const auto found = FamilyRule(section, d)({});
    CHECK(found.bonds.empty());
    CHECK(std::isfinite(found.a));
  }
  const auto p = ParameterRule(section, small_plate::spaced(1))({});
  CHECK(p.a == 0);
  CHECK(p.b == 0);
}
