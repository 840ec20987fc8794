#include "post/factors/interaction.hpp"

#include "plate/formulation/discretised.hpp"
#include "plate/formulation/tip_view.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace post;

TEST_CASE("interaction integrals: a plate that is lifted has no factors") {
  const auto file = case_text::read(
      case_text::plain, {"discretization.spacing=0.04", "section.thickness=0.3", "discretization.formulation=galerkin",
                         "geometry.cracks=[[[-0.35,-0.1],[0.3,0.2]]]"});
  const auto plate = plate::discretise(file.content).plate;
  const auto view = plate->tip_view();
  plate::Section s = view->section;
  s.orthotropic = {140, 10, 0.3, 5, 30, 12, 20};
  for (const auto& section : {view->section, s})
    for (const auto& tip : plate->tips()) {
      const auto integrals =
          interaction_integrals(*view, tip, TipSection(section, tip.direction), {{0.1, 0.2}, {0.15, 0.3}});
      REQUIRE(integrals.size() == 2);
      plate::State lift = plate::State::Zero(3, Eigen::Index(plate->points()));
      lift.row(0).setOnes();
      for (const auto& integral : integrals) {
        CHECK(integral(NearField(lift, view->positions, {})).norm() < 1e-9);
        CHECK(integral.points.size() > 50);
      }
    }
}
