#include "cases/papers/bodies/clamped_plate.hpp"

#include "tests/catch.hpp"

namespace bb = boundary_bodies;

TEST_CASE("clamped plate: Ritz's solution is 0 on the edges, u symmetric, v antisymmetric") {
  const bb::RitzClampedPlate ritz(6);
  const double size = ritz({1.5, 1, 0}).norm();
  CHECK(size > 0);
  for (const auto& at : {Eigen::Vector3d(0, 0.7, 0), Eigen::Vector3d(1.1, 2, 0), Eigen::Vector3d(3, 1.4, 0)})
    CHECK(ritz(at).norm() < 1e-12 * size);
  const Eigen::Vector3d one = ritz({0.4, 0.5, 0}), across = ritz({2.6, 0.5, 0}), above = ritz({0.4, 1.5, 0});
  CHECK(one[0] == Approx(across[0]));
  CHECK(one[1] == Approx(-across[1]));
  CHECK(one[1] == Approx(-above[1]));
  CHECK(std::abs(one[1]) > 0.01 * size);
}
