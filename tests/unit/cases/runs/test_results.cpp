#include "cases/runs/results.hpp"

#include "plate/formulation/interpolation.hpp"
#include "plate/model/errors.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace fracture;
namespace vp = verified_plate;

TEST_CASE("results: an error of the numbers is told with the place of its point and the step of the motion") {
  const auto plate = vp::assembled(vp::square(0.5));
  post::Summary summary;
  CHECK(placed(plate::NumericalError("w is not finite", 5), *plate, summary).what() ==
        std::string("w is not finite; the point is at (-0.25, -0.25)"));
  CHECK(placed(plate::NumericalError("no equilibrium"), *plate, summary).what() == std::string("no equilibrium"));
  CHECK(placed(plate::NumericalError("odd", 1000000), *plate, summary).what() == std::string("odd"));
  summary.analysis.time_step = 0.02, summary.analysis.time_step_limit = 0.016;
  CHECK(placed(plate::NumericalError("odd"), *plate, summary).what() ==
        std::string("odd; the time step 0.02 is 1.25 of the stable one"));
}

TEST_CASE("results: probes by their names, with shares of points that show a linear field as it is") {
  const auto plate = vp::assembled(vp::square(0.25));
  const auto probes = probes_of({{"b", {0.3, -0.41}}, {"a", {-0.99, 0.99}}}, *plate);
  REQUIRE(probes.size() == 2);
  CHECK(probes[0].name == "a");
  for (const auto& probe : probes) {
    geometry::Point at(0, 0);
    double sum = 0;
    for (const auto& [point, share, lever] : probe.shares)
      at += share * plate->cloud().positions[point] + lever, sum += share;
    CHECK(sum == Approx(1));
    CHECK((at - probe.position).norm() < 1e-6);  // measured: 1e-7, beyond the outermost points
  }
}
