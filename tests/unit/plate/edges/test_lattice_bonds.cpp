#include "plate/edges/lattice_bonds.hpp"
#include "tests/catch.hpp"

using namespace plate;

TEST_CASE("lattice bonds: a full family, alike in opposite directions, as far as the horizon") {
  Discretization d;
  d.spacing = 0.5;
  const auto all = lattice_bonds({200, 0.25, 0.3}, d);
  CHECK(all.bonds.size() == 28);
  CHECK(all.reach == 3);
  for (const auto& bond : all.bonds) {
    CHECK(bond.length == Approx(0.5 * bond.away.matrix().cast<double>().norm()));
    const auto opposite =
        std::ranges::find_if(all.bonds, [&](const auto& other) { return (other.away + bond.away).matrix().isZero(); });
    REQUIRE(opposite != all.bonds.end());
    CHECK(opposite->mx == -bond.mx);
    CHECK(opposite->curvature == bond.curvature);
    CHECK(opposite->shear == bond.shear);
  }
}

TEST_CASE("lattice bonds: with fitted shares of cells homogeneous bending and shear have the plate's stiffness") {
  const Section section{200, 0.25, 0.3};
  Discretization d;
  d.spacing = 0.5, d.volume_correction = VolumeCorrection::lattice_fitted;
  const auto all = lattice_bonds(section, d);
  double bending = 0, twist = 0, shear = 0, dilatation = 0;  // energies of unit curvature and shear, twice, per area
  for (const auto& bond : all.bonds) {
    const double x = bond.length * bond.my * bond.my, y = bond.length * bond.mx * bond.my;
    bending += bond.curvature / 2 * x * x;
    twist += bond.curvature / 2 * y * y;
    shear += bond.shear / 2 * bond.length * bond.length * bond.my * bond.my;
    dilatation += bond.D * x;
  }
  const double area = d.spacing * d.spacing, both = all.dilatation_stiffness * dilatation * dilatation;
  CHECK((bending + both) / area == Approx(section.bending_stiffness()).epsilon(1e-12));
  CHECK((twist + both) / area == Approx(section.poisson * section.bending_stiffness()).epsilon(1e-12));
  CHECK(shear / area == Approx(section.shear_stiffness()).epsilon(1e-12));
}
