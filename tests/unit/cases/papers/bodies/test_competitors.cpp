#include "cases/papers/bodies/competitors.hpp"

#include "cases/papers/bodies/plane.hpp"
#include "tests/catch.hpp"

namespace bb = boundary_bodies;

TEST_CASE("competitors: mirror nodes and the differential operator have a uniform field, the first with derivatives") {
  const auto square = bb::plane_square(0.3, 14);
  const auto field = bb::pulled_square(0.3);
  const auto off = [&](const Eigen::VectorXd& u) { return bb::largest_errors(square, u, field).maxCoeff(); };
  CHECK(off(bb::with_mirror_nodes(square, bb::pulled(1, 1), true)) < 1e-9);
  CHECK(off(bb::with_mirror_nodes(square, bb::pulled(1, 1), false)) > 0.1);
  CHECK(off(bb::with_differential_operator(square, bb::pulled(1, 1), field)) < 1e-8);
  const Eigen::MatrixXd K = bb::position_aware_stiffness(square);
  CHECK((K - K.transpose()).norm() < 1e-12 * K.norm());
}
