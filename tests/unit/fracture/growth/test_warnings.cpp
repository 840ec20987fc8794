#include "fracture/growth/growth.hpp"

#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace fracture;
namespace vp = verified_plate;

namespace {

Growth warned_growth(Growth::Criterion criterion) {
  Growth result;
  result.criterion = criterion;
  result.fracture_energy = 2;
  return result;
}

/// What is said of a plate so many spacings thick.
std::vector<std::string> said(Growth by, double thickness, double poisson = 0.3,
                              plate::SupportKind kind = plate::SupportKind::clamped) {
  auto c = vp::square(0.2);
  c.section.thickness = 0.2 * thickness, c.section.poisson = poisson;
  c.supports = {vp::held(kind, {"left"})};
  return warnings_about_bonds(by, *vp::assembled(c));
}

}  // namespace

TEST_CASE("distrust of bonds: where the apparent toughness was not measured, and not where it is given") {
  using enum Growth::Criterion;
  CHECK(said(warned_growth(bond_energy), 1).empty());
  CHECK(said(warned_growth(curvature_shear), 2).empty());
  for (const auto& warnings : {said(warned_growth(bond_energy), 0.3), said(warned_growth(bond_energy), 60),
                               said(warned_growth(curvature_shear), 1), said(warned_growth(bond_energy), 1, -0.1)}) {
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], Catch::Contains("apparent toughness"));
  }
  auto given = warned_growth(bond_energy);
  given.apparent_toughness = 1.1;
  CHECK(said(given, 0.3).empty());
  CHECK(said(warned_growth(energy_release), 0.3).empty());  // tips, not bonds
}

TEST_CASE("distrust of bonds: a crack through points is on one side of them") {
  using enum Growth::Criterion;
  for (const auto criterion : {bond_energy, energy_release})
    for (const double y : {0.1, 0.13, 0.2}) {
      CAPTURE(y);
      auto c = vp::square(0.2);  // points at 0.1, 0.3, ...
      c.section.thickness = 0.2;
      c.supports = {vp::held(plate::SupportKind::clamped, {"left"})};
      c.cracks = {{{-0.45, y}, {0.45, y}}};
      const auto warnings = warnings_about_bonds(warned_growth(criterion), *vp::assembled(c));
      REQUIRE(warnings.size() == (y == 0.1 ? 1 : 0));
      if (y == 0.1) CHECK_THAT(warnings[0], Catch::Contains("through points") && Catch::EndsWith("= 0.1818"));
    }
}

TEST_CASE("distrust of bonds: no crack crosses a line of symmetry") {
  const auto warnings = said(warned_growth(Growth::Criterion::bond_energy), 1, 0.3, plate::SupportKind::symmetry);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Catch::Contains("line of symmetry"));
}

TEST_CASE("tips without rings: those next to something, with how near it is") {
  auto c = vp::square(0.05);
  c.cracks = {{{-0.4, 0}, {0.4, 0}}, {{0.6, 0.7}, {0.875, 0.7}}};
  const auto said = tips_without_rings(*vp::assembled(c));
  REQUIRE(said.size() == 2);  // of the second: 2.5 spacings from the edge, and 5.5 from its own end, of which 0.7 count
  CHECK_THAT(said[0], Catch::StartsWith("tip at (0.6, 0.7): "));
  CHECK_THAT(said[1], Catch::StartsWith("tip at (0.875, 0.7): ") && Catch::Contains("2.5 spacings"));
}

TEST_CASE("distrust of what tips took: a twentieth from the fracture energy, and not of bonds") {
  plate::Section section;
  section.young = 1, section.poisson = 0.25, section.thickness = 0.1, section.density = 0.4;
  const auto said = [&](double spent, Growth::Criterion by = Growth::Criterion::energy_release) {
    MovingGrowthOutcome outcome;
    outcome.spent = spent, outcome.largest_speed = 0.93 * section.shear_wave_speed();
    return warnings_about_spent_energy(warned_growth(by), outcome, section, "refine");
  };
  CHECK(said(0.96).empty());
  CHECK(said(1.04).empty());
  CHECK(said(0.94).size() == 1);
  CHECK(said(1.06).size() == 1);
  CHECK(said(16, Growth::Criterion::bond_energy).empty());
  CHECK(warnings_about_spent_energy(warned_growth(Growth::Criterion::energy_release), {}, section, "refine").empty());
  REQUIRE(said(16.6).size() == 1);
  CHECK_THAT(said(16.6)[0], Catch::Contains("16.60 times") && Catch::Contains("0.93 of the speed of shear waves"));
  REQUIRE(said(0.5).size() == 1);
  CHECK_THAT(said(0.5)[0], Catch::StartsWith("tips took 0.50 times the fracture energy over 0 pieces") &&
                               Catch::EndsWith("; refine"));
}

TEST_CASE("distrust of directions: tips that stopped, each with its reason, and those that went straight on unseen") {
  MovingGrowthOutcome outcome;
  CHECK(warnings_about_directions(outcome, "refine").empty());
  outcome.direction_unknown = true, outcome.stopped = {"tip 0 would turn by 64 degrees"};
  const auto said = warnings_about_directions(outcome, "refine");
  REQUIRE(said.size() == 2);
  CHECK_THAT(said[0], Catch::Contains("went straight on; refine"));
  CHECK_THAT(said[1], Catch::StartsWith("tip 0 would turn by 64 degrees: it stopped there; set `direction`"));
  outcome.unsteady = {"tip 1 took 3 times"};
  CHECK_THAT(warnings_about_directions(outcome, "refine").at(2),
             Catch::Equals("tip 1 took 3 times: it stopped there; refine"));
}
