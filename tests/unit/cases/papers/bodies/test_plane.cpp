#include "cases/papers/bodies/plane.hpp"

#include "tests/catch.hpp"

namespace bb = boundary_bodies;

TEST_CASE("plane: the local field when pulled is that of plane strain, the lattice's is near it") {
  for (const double poisson : {0.0, 0.2, 0.3}) {
    const Eigen::Vector3d u = bb::pulled_square(poisson)({1, 1, 0});
    CHECK(u[0] == Approx(-poisson * (1 + poisson)).margin(1e-14));  // Sca23 43, E = p = 1
    CHECK(u[1] == Approx(1 - poisson * poisson));
    const Eigen::Vector3d lattice = bb::pulled_square_of_lattice(bb::plane_square(poisson, 8))({1, 1, 0});
    CHECK((lattice - u).norm() < 0.02);
  }
}
