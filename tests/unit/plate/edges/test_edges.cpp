#include "plate/edges/boundary_conditions.hpp"

#include "plate/model/errors.hpp"
#include "tests/catch.hpp"

using namespace plate;
using geometry::Point;

TEST_CASE("edges: what supports hold") {
  CHECK(edge_condition(SupportKind::free).held == std::array{false, false, false});
  CHECK(edge_condition(SupportKind::clamped).held == std::array{true, true, true});
  CHECK(edge_condition(SupportKind::simply_supported).held == std::array{true, false, false});
  CHECK(edge_condition(SupportKind::simply_supported_hard).held == std::array{true, false, true});
  CHECK(edge_condition(SupportKind::symmetry).held == std::array{false, true, false});
}

TEST_CASE("edges: what acts on them, or what they are brought to") {
  EdgeAction action;
  action.moment = 2, action.deflection = 0.5;
  const auto c = edge_condition(SupportKind::simply_supported, action);
  CHECK(c.value == std::array{0.5, 2.0, 0.0});
}

TEST_CASE("edges: loads on what is held, values of what is not, layers and pins are refused with the reason") {
  EdgeAction action;
  action.shear = 1;
  try {
    edge_condition(SupportKind::clamped, action, 3);
    FAIL("a shear on a clamp");
  } catch (const Refused& refused) {
    CHECK(refused.reasons().front().subject == Subject::load_edges);
    CHECK(refused.reasons().front().number == 3);
    CHECK(std::string(refused.what()).find("deflection is held") != std::string::npos);
  }
  CHECK_NOTHROW(edge_condition(SupportKind::symmetry, action));
  action = {}, action.tangential_rotation = 1;
  CHECK_THROWS_AS(edge_condition(SupportKind::simply_supported, action), Refused);
  CHECK_NOTHROW(edge_condition(SupportKind::simply_supported_hard, action));
  CHECK_THROWS_AS(edge_condition(SupportKind::clamped_layer), Refused);
  CHECK_THROWS_AS(edge_condition(SupportKind::pinned), Refused);
}

TEST_CASE("edges: section forces do the work of their rotations") {
  // -M_nn psi_n - M_ns psi_s + Q w, as moments put z > 0 in tension and (u, v) = -z psi
  const Eigen::Vector3d forces(2, 3, -5), values(0.7, -0.2, 0.4);
  for (const Point& n : {Point(1, 0), Point(-1, 0), Point(0, 1), Point(0, -1)})
    CHECK(conjugate(forces, n).dot(rotated(values, n)) == Approx(2 * 0.7 + 3 * 0.2 + 5 * 0.4));
  CHECK(rotated({0, 1, 0}, {1, 0}) == Eigen::Vector3d(0, 0, -1));  // psi_x = -theta_y
  CHECK(rotated({0, 1, 0}, {0, 1}) == Eigen::Vector3d(0, 1, 0));   // psi_y = theta_x
  CHECK(rotated({0, 0, 1}, {1, 0}) == Eigen::Vector3d(0, 1, 0));
  CHECK(normal_rotation(0) == 2);
  CHECK(tangential_rotation(0) == 1);
}
