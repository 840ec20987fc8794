// Where deflection and stress of a run are largest.
#include "post/report/conclusion.hpp"

#include "cases/driver/prepared.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/sections.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/statics.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

std::vector<std::string> settings_of(const std::string& formulation, std::vector<std::string> more) {
  more.push_back("discretization.formulation=" + formulation);
  return more;
}

}  // namespace

TEST_CASE("extremes: the place of the largest deflection, and the stress of the row with the most strain energy") {
  for (const std::string formulation : {"galerkin", "ordinary"}) {
    const auto file = read(plain, settings_of(formulation, {"geometry.cracks=[]"}));
    const auto plate = cases::discretised(file).plate;
    const plate::State state = plate::static_solution(*plate, file.content.analysis, {1e-8, 10000, {}}).solution.state;
    const plate::State half = -0.5 * state, none = 0 * state;
    post::Extremes extremes(*plate);
    CHECK(extremes.found().empty());
    extremes.row({0, 0, none, {}, 0, 0, 0, 0, {}, {}});
    extremes.row({1, 0.1, state, {}, 0, 0, 4, 0, {}, {}});
    extremes.row({2, 0.2, half, {}, 0, 0, 1, 0, {}, {}});
    extremes.frame(0.2, plate->resultants(half));
    const auto found = extremes.found();
    REQUIRE(found.size() == 2);
    CAPTURE(formulation, *found[0].position, *found[1].position);
    CHECK(found[0].quantity == "w");
    CHECK(found[0].time == 0.1);
    CHECK(found[0].value == Approx(state.row(0).maxCoeff()));
    CHECK(found[0].position->x() > 0.9);  // the free end of the cantilever
    CHECK(found[1].quantity == "von_mises");
    CHECK(found[1].time == 0.1);
    CHECK(found[1].position->x() < -0.9);     // beside the clamp
    CHECK(*found[1].outside == Approx(0.2));  // of the corners of the clamp, four spacings
    CHECK(std::abs(found[1].position->y()) < 0.8);
    CHECK(found[1].value == Approx(6 / 0.01 * 2).epsilon(0.12));  // p L^2 / 2 of the root, bonds half a cell away
  }
}

TEST_CASE("extremes: what is next to tips, pins and point forces does not count, and does not grow with the points") {
  for (const std::string formulation : {"galerkin", "ordinary"})
    for (const auto& [setting, place] :
         {std::pair{"geometry.cracks=[[[-0.3,0],[0.3,0]]]", geometry::Point(0.3, 0)},
          std::pair{"load=[{kind=\"point_force\",position=[0.3,0.025],value=1}]", geometry::Point(0.3, 0.025)}}) {
      std::vector<double> stresses, whole;
      for (const char* spacing : {"discretization.spacing=0.03125", "discretization.spacing=0.015625"}) {
        const auto file = read(
            plain,
            settings_of(formulation, {spacing, "section.thickness=0.4", setting,
                                      "support=[{kind=\"clamped\",edges=[\"left\",\"right\",\"bottom\",\"top\"]}]"}));
        const auto plate = cases::discretised(file).plate;
        const auto state = plate::static_solution(*plate, file.content.analysis, {1e-8, 10000, {}}).solution.state;
        post::Extremes extremes(*plate);
        extremes.row({0, 0, state, {}, 0, 0, 1, 0, {}, {}});
        const auto found = extremes.found();
        REQUIRE(found.size() == 2);
        CHECK(*found[1].outside == Approx(0.2));
        CHECK((*found[1].position - place).norm() >= 0.2);
        stresses.push_back(found[1].value);
        whole.push_back(plate->resultants(state).von_mises.maxCoeff());
      }
      CAPTURE(formulation, setting, stresses, whole);
      CHECK(stresses[1] == Approx(stresses[0]).epsilon(0.15));
    }
}
