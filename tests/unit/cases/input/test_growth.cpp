#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("growth: what it needs, and what it cannot do") {
  const std::string growth = plain + "[growth]\n";  // line 18
  expect(growth + "criterion = \"energy_release\"\n", ":18", "growth.fracture_energy", "is missing");
  expect(growth + "fracture_energy = 0\n", ":19", "growth.fracture_energy", "must be a number > 0");
  expect(growth + "fracture_energy = 1\ncriterion = \"stretch\"\n", ":20", "growth.criterion",
         "must be one of \"energy_release\"");
  expect(growth + "fracture_energy = 1\nno_fail = [[0, 0, 0, 1]]\n", ":20", "growth.no_fail[0]", "with xmin < xmax");
  expect(with_line(growth + "fracture_energy = 1\n", 7, ""), ":18", "growth", "there is no crack tip that could grow");
  expect(growth + "fracture_energy = 1\n[srif]\nmethods = [\"displacement_extrapolation\"]\n", ":21", "srif.methods",
         "growth needs an energy release rate");
  expect(growth + "fracture_energy = 1\n[srif]\nsecond_formulation = true\n", ":21", "srif.second_formulation",
         "cracks that grow differ between formulations");
  const auto motion =
      with_line(growth + "fracture_energy = 1\n", 17, "kind = \"dynamic\"\nduration = 1");  // growth at 19
  expect(motion, "--set discretization.formulation", "discretization.formulation",
         "growth in motion severs bonds over a horizon", {"section.density=1", "discretization.formulation=galerkin"});
  expect(motion + "control = \"load\"\n", ":21", "growth.control", "is used in statics only", {"section.density=1"});
}

TEST_CASE("growth by single bonds: what it needs, and what it cannot do") {
  const std::string bonds = plain + "[growth]\ncriterion = \"bond_energy\"\n";  // line 18
  expect(bonds, ":18", "growth.fracture_energy", "is missing");
  expect(bonds + "fracture_energy = 1\ndirection = \"straight\"\n", ":21", "growth.direction",
         "bonds break where they fail");
  expect(bonds + "fracture_energy = 1\ncritical_shear = 1\n", ":21", "growth.critical_shear",
         "of criterion = \"curvature_shear\"");
  expect(bonds + "fracture_energy = 1\n", "--set analysis.method", "analysis.method",
         "breaking bonds takes a solution for each", {"analysis.method=direct"});
  expect(bonds + "fracture_energy = 1\n", "--set analysis.preconditioner", "analysis.preconditioner",
         "one of their own", {"analysis.preconditioner=local"});
  expect(bonds + "fracture_energy = 1\nmax_length = 0.6\n", ":21", "growth.max_length",
         "must be larger than the 0.6 of geometry.cracks");
  expect(bonds + "fracture_energy = 1\n", "--set discretization.formulation", "discretization.formulation",
         "bonds that break one by one are bonds over a horizon", {"discretization.formulation=galerkin"});
  expect(bonds + "fracture_energy = 1\nunstable = \"move\"\nduration = 1\n", ":21", "growth.unstable",
         "needs crack tips that run on", {"section.density=1"});
  expect(plain + "[growth]\nfracture_energy = 1\napparent_toughness = 1.1\n", ":20", "growth.apparent_toughness",
         "of criteria for bonds");
  // limits in place of the fracture energy; no crack is needed where bonds break one by one
  CHECK(read(with_line(plain, 7, "") + "[growth]\ncriterion = \"curvature_shear\"\ncritical_curvature = 2\n")
            .content.growth->critical_curvature == 2);
}

TEST_CASE("growth that goes over into motion needs what motion needs") {
  const std::string moves = plain + "[growth]\nfracture_energy = 1\nunstable = \"move\"\n";  // line 18
  expect(moves, ":18", "growth.duration", "is missing", {"section.density=1"});
  expect(moves + "duration = 1\n", ":1", "section.density", "the plate may begin to move");
  expect(moves + "duration = 1\ncontrol = \"displacement\"\n", ":22", "growth.control", "must be \"load\"",
         {"section.density=1"});
  expect(plain + "[growth]\nfracture_energy = 1\nduration = 1\n", ":20", "growth.duration",
         "is of unstable = \"move\"");
}
