#include "plate/formulation/sections.hpp"

#include "plate/model/errors.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"

using namespace plate;
namespace gp = galerkin_plate;

TEST_CASE("sections of points: one for all, or means over their cells that add up to the plate") {
  const auto outline = geometry::rectangle(0, 0, 1, 1);
  CHECK(PointSections(gp::section).simple());
  const auto cells = gp::cells(outline, 0.1);
  CHECK(PointSections(gp::section, cells).uniform());
  Section s = gp::section;
  s.thickness_factor = Formula("1 + x + 2 * y");
  s.young_factor = Formula("2 - y");
  for (const auto& some : {cells, gp::perturbed(cells, 0.3)}) {
    const PointSections sections(s, some);
    CHECK_FALSE(sections.uniform());
    const auto areas = galerkin_families(some).areas;
    double mass = 0;
    for (std::size_t k = 0; k < areas.size(); ++k) mass += areas[k] * sections[k].mass;
    CHECK(mass == Approx(2 * 0.1 * 2.5).epsilon(1e-13));  // linear: the rule is exact
    for (std::size_t k = 0; k < areas.size(); ++k) {
      const Section there = s.at(some.positions[k]);
      CHECK(sections[k].bending(0, 0) == Approx(there.bending_stiffness()).epsilon(0.4));
    }
  }
}

TEST_CASE("sections of points: what is no section is refused with its place") {
  const auto cells = gp::cells(geometry::rectangle(0, 0, 1, 1), 0.1);
  for (const char* text : {"x - 0.5", "1 / (x - 0.5) - 3", "0"}) {
    Section s = gp::section;
    s.thickness_factor = Formula(text);
    CHECK_THROWS_AS(PointSections(s, cells), Refused);
    s = gp::section;
    s.young_factor = Formula(text);
    try {
      PointSections(s, cells);
      FAIL();
    } catch (const Refused& refused) {
      CHECK(refused.reasons()[0].subject == Subject::young_factor);
      CHECK_THAT(refused.what(), Catch::Contains("must be > 0"));
    }
  }
}
