#include <fmt/format.h>

#include "cases/driver/prepared.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

const std::string bonds_case = with_line(plain, 9, "spacing = 0.05\nformulation = \"ordinary\"");

struct Checked {
  std::vector<cases::Problem> problems;
  std::vector<std::string> warnings;
};

/// What the lattice of a case cannot carry, and what is said of it.
Checked checked(const std::vector<std::string>& settings) {
  try {
    return {{}, cases::discretised(read(bonds_case, settings)).warnings};
  } catch (const cases::CaseError& error) {
    return {error.problems(), {}};
  }
}

void refuses(const std::vector<std::string>& settings, const std::string& key, const std::string& what) {
  const auto found = checked(settings).problems;
  for (const auto& problem : found) UNSCOPED_INFO(problem.key << " " << problem.what);
  REQUIRE(found.size() == 1);
  CHECK(found[0].key == key);
  CHECK_THAT(found[0].what, Catch::Contains(what));
}

void accepts(const std::vector<std::string>& settings) {
  const auto found = checked(settings).problems;
  for (const auto& problem : found) UNSCOPED_INFO(problem.key << " " << problem.what);
  CHECK(found.empty());
}

/// The square of 2 by 2, points 0.05 apart, with a strip of this width on its right side (edge2 to edge4).
std::string with_strip(double half_width) {
  return fmt::format("geometry.outline={{polygon=[[-1,-1],[1,-1],[1,{0}],[3,{0}],[3,{1}],[1,{1}],[1,1],[-1,1]]}}",
                     -half_width, half_width);
}

const std::string left = "support=[{kind=\"clamped\",edges=[\"edge0\"]}]";

}  // namespace

TEST_CASE("parts of a plate that no point stands for are refused") {
  refuses({with_strip(0.015), left}, "discretization.spacing",
          "on its outline is over 12 spacings from the nearest point");
  refuses({with_strip(0.015), left}, "discretization.spacing", "cover 4.002 of its area 4.06");
  accepts({with_strip(0.06), left});
  accepts({with_strip(0.015), left, "discretization.formulation=galerkin"});
  // a ligament between a hole and an edge
  refuses({"geometry.holes=[{circle=[0.48,0.48,0.5]}]", "geometry.cracks=[]"}, "discretization.spacing",
          "leaves out a part");
  accepts({"geometry.holes=[{circle=[0.3,0.3,0.5]}]", "geometry.cracks=[]"});
  // corners, which points never fill
  accepts({"geometry.outline={polygon=[[-1,-1],[1,-1],[1,1]]}", "geometry.cracks=[]", left});
  accepts({"geometry.outline={polygon=[[-1,-1],[1,-1],[1,-0.4]]}", "geometry.cracks=[]", left});
  accepts({"geometry.outline={polygon=[[0,-1.3],[1.3,0],[0,1.3],[-1.3,0]]}", left});
}

TEST_CASE("loads, pins and probes where no point is are refused") {
  const auto all =
      checked({with_strip(0.015), "support=[{kind=\"clamped\",edges=[\"edge0\"]},{kind=\"pinned\",points=[[2,0]]}]",
               "load=[{kind=\"edge_shear\",edges=[\"edge3\"],value=1},{kind=\"point_force\",position=[2,0],value=1}]"});
  std::vector<std::string> keys;
  for (const auto& problem : all.problems) keys.push_back(problem.key);
  CHECK(keys ==
        std::vector<std::string>{"discretization.spacing", "load[0].edges", "support[1].points", "load[1].position"});
  // in a sharp corner, which points never fill
  refuses({"geometry.outline={polygon=[[-1,-1],[1,-1],[1,-0.4]]}", "geometry.cracks=[]", left,
           "output.probes={far=[-0.99,-0.999], near=[0.5,-0.8]}"},
          "output.probes.far", "spacings from the nearest point of the lattice");
  keys.clear();  // together with what else the points show
  for (const auto& problem :
       checked({"geometry.outline={polygon=[[-1,-1],[1,-1],[1,-0.4]]}", "geometry.cracks=[]",
                "support=[{kind=\"pinned\",points=[[0.5,-0.8],[0.9,-0.9]]}]", "output.probes={far=[-0.99,-0.999]}"})
           .problems)
    keys.push_back(problem.key);
  CHECK(keys == std::vector<std::string>{"support", "output.probes.far"});
}

TEST_CASE("bonds cannot hold a plate on less than a spacing of an edge") {
  const auto outline = [](double length) {
    return fmt::format("geometry.outline={{polygon=[[-1,-1],[1,-1],[1,{}],[1,1],[-1,1]]}}", length - 1);
  };
  const std::string right = "support=[{kind=\"clamped\",edges=[\"edge1\"]}]";
  refuses({outline(0.025), right}, "support[0].edges", "a length of 0.5 spacings");
  accepts({outline(0.1), right});
  accepts({outline(0.025), right, "discretization.formulation=galerkin"});
  accepts({outline(0.025), "support=[{kind=\"clamped\",edges=[\"edge1\",\"edge2\"]}]"});
}

TEST_CASE("pins near one line hold a plate by where their points happen to lie") {
  const auto pins = [](double aside) {
    return fmt::format("support=[{{kind=\"pinned\",points=[[-1,-1],[0,{}],[1,1]]}}]", aside);
  };
  const std::string whole = "geometry.cracks=[]";
  refuses({pins(0.03), whole}, "support", "the pins are within 0.28 spacings of one line");
  const auto warnings = checked({pins(0.2), whole}).warnings;
  CHECK(std::ranges::any_of(
      warnings, [](const auto& one) { return one.find("deflections may be far off") != std::string::npos; }));
  const auto none = checked({pins(1), whole}).warnings;
  CHECK(std::ranges::none_of(
      none, [](const auto& one) { return one.find("deflections may be far off") != std::string::npos; }));
}

TEST_CASE("pins for which one point of the lattice would stand are refused with bonds") {
  const auto pins = [](double y) {
    return fmt::format(
        "support=[{{kind=\"pinned\",points=[[-0.5,-0.5],[0.5,-0.5]]}},"
        "{{kind=\"pinned\",points=[[0.5,{}]]}},{{kind=\"pinned\",points=[[0.5,0.8]]}}]",
        y);
  };
  const std::string whole = "geometry.cracks=[]";
  refuses({pins(-0.52), whole}, "support[1].points", "the pins at (0.5, -0.5) and (0.5, -0.52) are next to the same");
  accepts({pins(-0.52), whole, "discretization.formulation=galerkin"});
  accepts({pins(-0.5), whole});
  accepts({pins(-0.7), whole});
}
