#include "plate/solve/coupled_modes.hpp"

#include "cases/input/case_file.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/motion/frequencies.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace plate;

namespace {

/// A plate with an eccentric rib, which loads in its plane press.
Discretised ribbed_and_pressed(double pressed) {
  return discretise(
      case_text::read(
          case_text::plain,
          {"discretization.formulation=galerkin", "discretization.spacing=0.1", "geometry.cracks=[]",
           "section.density=2", "support=[{ kind = 'clamped', edges = ['left', 'right', 'bottom', 'top'] }]",
           "stiffener=[{ along = [[-0.8, 0.1], [0.8, 0.1]], bending = 0.5, axial = 3, eccentricity = 0.1 }]",
           "load=[{ kind = 'edge_traction', edges = ['left', 'right'], value = -" + std::to_string(pressed) + " }]"})
          .content);
}

FrequencyOptions options_of(const Formulation& plate) {
  FrequencyOptions result;
  result.modes = 3, result.tolerance = 1e-8, result.shift = shift_of(plate.section(), 1);
  return result;
}

}  // namespace

TEST_CASE("coupled modes: frequencies fall under pressure, and beyond buckling there are none") {
  const auto plates = ribbed_and_pressed(1);
  const auto &plate = *plates.plate, &membrane = *plates.membrane;
  const auto options = options_of(plate);
  const auto prestress = coupled_prestress(plate, membrane);
  const auto buckles = coupled_buckling(plate, membrane, prestress.geometric, 1, 1e-8);
  REQUIRE(buckles.size() == 1);
  const auto lowest = [&](double share) {
    PointMatrix geometric = prestress.geometric;
    for (auto& block : geometric.block) block *= share * buckles[0].factor;
    return coupled_frequencies(plate, membrane, 1, &geometric, options).modes.at(0).frequency;
  };
  const double free = coupled_frequencies(plate, membrane, 1, nullptr, options).modes.at(0).frequency;
  CHECK(lowest(0.5) < free);
  CHECK(lowest(0.999) < 0.1 * free);
  CHECK_THROWS_WITH(lowest(5), Catch::Contains("buckles below these loads"));
}
