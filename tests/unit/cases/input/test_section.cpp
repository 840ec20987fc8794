#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

const std::string rest = plain.substr(plain.find("[geometry]"));
const std::string carbon = "E1 = 140, E2 = 10, nu12 = 0.3, G12 = 5, G13 = 4, G23 = 3";

std::string section(const std::string& lines) {
  return "[section]\n" + lines + "\n" + rest;
}

std::string isotropic(const std::string& line) {
  return section("young = 1000.0\npoisson = 0.3\nthickness = 0.1\n" + line);
}

}  // namespace

TEST_CASE("orthotropic sections are read, written again and checked") {
  const auto text = section("thickness = 0.1\northotropic = { " + carbon + ", angle = 30 }");
  const auto content = read(text).content;
  CHECK(content.section.orthotropic->E1 == 140);
  CHECK(content.section.orthotropic->angle == 30);
  CHECK(content.formulation_reason == "auto: nothing asks for bonds");
  const auto again = read(cases::resolved_toml(content)).content;
  CHECK(again.section.orthotropic->G23 == 3);
  expect(section("thickness = 0.1\nyoung = 3\northotropic = { " + carbon + " }"), ":3", "section.young",
         "is used with neither orthotropic nor plies only");
  expect(section("thickness = 0.1\northotropic = { E1 = 140, E2 = 10, nu12 = 4, G12 = 5, G13 = 4, G23 = 3 }"), ":3",
         "section.orthotropic.nu12", "must be below sqrt(E1 / E2)");
  expect(section("thickness = 0.1\northotropic = { E1 = 140, E2 = 10, nu12 = 0.3, G12 = -5, G13 = 4, G23 = 3 }"), ":3",
         "section.orthotropic.G12", "-5 given");
  expect(section("thickness = 0.1\northotropic = { E1 = 140, E2 = 10, nu12 = 0.3, G12 = 5, G13 = 4 }"), ":3",
         "section.orthotropic.G23", "is missing");
  expect(text, ":3", "section.orthotropic", "bonds share their weights", {"discretization.formulation=ordinary"});
}

TEST_CASE("sections of plies: their thickness is the plies', and those that are not symmetric are coupled") {
  const auto ply = [](const std::string& more) { return "{ " + carbon + ", " + more + " }"; };
  const auto content =
      read(section("plies = [" + ply("thickness = 0.1, angle = 90") + ", " + ply("thickness = 0.3, density = 7") +
                   ", " + ply("thickness = 0.1, angle = -90") + "]"))
          .content;
  CHECK(content.section.thickness == Approx(0.5));
  CHECK(*content.section.plies[1].density == 7);
  CHECK(read(cases::resolved_toml(content)).content.section.plies.size() == 3);
  CHECK_FALSE(content.coupled());
  const auto angle_ply =
      section("plies = [" + ply("thickness = 0.1, angle = 45") + ", " + ply("thickness = 0.1, angle = -45") + "]");
  CHECK(read(angle_ply).content.coupled());
  expect(angle_ply + "[srif]\n", ":16", "srif", "make section.plies symmetric");
  CHECK(problems(angle_ply, {"foundation=[{modulus=1,lifts_off=true}]"}).empty());
  expect(section("plies = [" + ply("thickness = 0.1") + "]\nthickness = 0.1"), ":3", "section.thickness",
         "is used with one material over the thickness only");
}

TEST_CASE("sections of plies: the density of the section is missed only where a ply has none") {
  const auto plies = [](const std::string& last) {
    return "plies = [{ " + carbon + ", thickness = 0.1, density = 7 }, { " + carbon + ", thickness = 0.1" + last +
           " }]";
  };
  const std::string weight = "load=[{kind='pressure',gravity=10}]";
  const auto own = read(section(plies(", density = 7")), {weight}).content;
  CHECK(own.loads[0].as<plate::Pressure>()->value == Approx(14));
  expect(section(plies("")), ":1", "section.density", "is the plate's own weight", {weight});
  const std::vector<std::string> modes{"analysis={kind='frequencies'}", "-load"};
  CHECK(read(section(plies(", density = 7")), modes).content.section.mass() == Approx(1.4));
  expect(section(plies("")), ":1", "section.density", "is missing, must be a number > 0", modes);
}

TEST_CASE("sections that vary are checked against the plate and its tips") {
  const auto region = [](const std::string& more) { return isotropic("regions = [{ " + more + " }]"); };
  CHECK(problems(region("on = { circle = [0.5, 0.5, 0.1] }, thickness = 0.2, density = 3")).empty());
  CHECK(read(cases::resolved_toml(read(region("on = { circle = [0.5, 0.5, 0.1] }, thickness = 0.2")).content))
            .content.section.regions[0]
            .thickness == 0.2);
  expect(region("on = { circle = [0.5, 0.5, 0.1] }"), ":5", "section.regions[0]", "changes nothing");
  expect(region("thickness = 0.2"), ":5", "section.regions[0].on", "is missing");
  expect(region("on = { circle = [5, 5, 0.1] }, thickness = 0.2"), ":5", "section.regions[0].on",
         "the region lies on nothing of the plate");
  expect(region("on = { circle = [0.5, 0.5, 0.1] }, thickness = -1"), ":5", "section.regions[0].thickness", "-1 given");
  expect(isotropic("thickness_factor = \"1 + z\""), ":5", "section.thickness_factor", "\"z\" at character 5");
  CHECK(read(isotropic("young_factor = \"1 + x * x\"")).content.section.young_factor.text() == "1 + x * x");
  const auto srif = isotropic("regions = [{ on = { circle = [0.4, 0, 0.05] }, thickness = 0.2 }]") + "[srif]\n";
  expect(srif, ":5", "section.regions", "no ring about it has one section");
  expect(isotropic("thickness_factor = \"1 + 0.1 * x\"") + "[srif]\n", ":5", "section.thickness_factor",
         "varies about the tip");
}
