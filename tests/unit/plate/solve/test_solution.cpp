#include "plate/solve/statics.hpp"

#include "plate/formulation/discretised.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("solution: in equilibrium the strain energy is half the work of the loads, whatever the way") {
  for (const char* way : {"analysis.method=direct", "analysis.preconditioner=diagonal"}) {
    INFO(way);
    const auto c = read(plain, {"discretization.spacing=0.1", way}).content;
    const auto plate = plate::discretise(c).plate;
    const auto found = plate::static_solution(*plate, c.analysis, {1e-10, 10000, {}});
    REQUIRE(found.solution.converged);
    const double work = plate->total_load().cwiseProduct(found.solution.state).sum();
    CHECK(plate->strain_energy(found.solution.state) == Approx(work / 2).epsilon(1e-6));
  }
}

TEST_CASE("solution: a motion starts from the loads of time 0, undeformed where there are none") {
  const auto moving = with_line(with_line(plain, 17, "kind = \"dynamic\"\nduration = 1\nstart = \"equilibrium\""), 4,
                                "thickness = 0.1\ndensity = 1");
  const auto start = [&](const std::string& history) {
    const auto c = read(moving, {"discretization.spacing=0.1", history}).content;
    const auto plate = plate::discretise(c).plate;
    return plate::start_of(*plate, c.analysis);
  };
  CHECK(start("load[0].history=[[0,0],[1,1]]").size() == 0);
  const auto half = start("load[0].history=[[0,0.5],[1,1]]"), whole = start("load[0].history=[[0,1],[1,1]]");
  REQUIRE(half.size() > 0);
  CHECK((2 * half - whole).norm() < 1e-4 * whole.norm());  // both to 1e-6 of their loads
}
