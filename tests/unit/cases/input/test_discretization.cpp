#include "plate/galerkin/galerkin_plate.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("what is not in this version is refused with the reason") {
  const auto discretization = [](const std::string& line) { return with_line(plain, 9, "spacing = 0.05\n" + line); };
  expect(discretization("formulation = \"finite_elements\""), ":10", "discretization.formulation",
         "must be one of \"ordinary\", \"galerkin\"");
  expect(discretization("surface_correction = \"position-aware\""), ":10", "discretization.surface_correction",
         "did you mean 'position_aware'?");
  expect(discretization("influence = \"invers\""), ":10", "discretization.influence", "did you mean 'inverse'?");
  expect(plain + "[srif]\nmethods = [\"j_integral\"]\n", ":19", "srif.methods",
         "must be one of \"virtual_crack_extension\"");
}

TEST_CASE("what the Galerkin plate has not is refused with the reason, and what it needs not may stay") {
  const auto galerkin = [](const std::string& line) {
    return with_line(plain, 9, "spacing = 0.05\nformulation = \"galerkin\"\n" + line);
  };
  CHECK(read(galerkin("surface_correction = \"position_aware\"\nhorizon_ratio = 3.015"))
            .content.discretization.formulation == &plate::galerkin);
  expect(galerkin("surface_correction = \"none\""), ":11", "discretization.surface_correction",
         "nothing is to be corrected");
  expect(galerkin("influence = \"constant\""), ":11", "discretization.influence", "points of the cells");
  expect(galerkin("twist_match = \"paper\""), ":11", "discretization.twist_match", "need no calibration");
  expect(with_line(plain, 9, "spacing = 0.05\nformulation = \"ordinary\"\ntip_spacing = 0.01"), ":11",
         "discretization.tip_spacing", "with formulation = galerkin only");
  expect(with_line(galerkin(""), 13, "kind = \"clamped_layer\""), ":13", "support[0].kind",
         "whose points lie on the edges");
  expect(galerkin("") + "\n", "--set analysis.preconditioner", "analysis.preconditioner", "formulation = \"ordinary\"",
         {"analysis.preconditioner=\"two_level\""});
  expect(plain, "--set analysis.preconditioner", "analysis.preconditioner", "formulation = \"galerkin\"",
         {"analysis.preconditioner=\"levels\"", "discretization.formulation=ordinary"});
}
