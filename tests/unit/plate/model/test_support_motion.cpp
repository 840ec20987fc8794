#include "plate/model/nodal_forces.hpp"

#include "plate/model/problem.hpp"
#include "tests/catch.hpp"

using namespace plate;
using geometry::Point;

TEST_CASE("supports move as rigid bodies, and edges turn about themselves") {
  Problem problem;
  problem.loads.resize(2);
  problem.loads[1].action = Settlement{.support = 3, .value = 0.5, .slope = {2, -1}, .from = {1, 1}, .rotation = 0.25};
  const auto motions = support_motions(problem);
  REQUIRE(motions.size() == 1);
  CHECK(motions[0].load == 1);
  CHECK(motions[0].settlement.support == 3);
  // psi = (2, -1): theta_x = psi_y, theta_y = -psi_x
  CHECK((motions[0].at({2, 1}) - Eigen::Vector3d(2.5, -1, -2)).norm() < 1e-14);
  CHECK((motions[0].at({2, 1}, {0, 1}, 0.5) - Eigen::Vector3d(2.625, -0.75, -2)).norm() < 1e-14);
}
