#include "cases/papers/bodies/loaded.hpp"

#include "cases/papers/bodies/boxes.hpp"
#include "tests/catch.hpp"

namespace bb = boundary_bodies;

TEST_CASE("loaded: half of a symmetric box has the displacements of the whole") {
  const bb::MadeBox body({6, 4, 4});
  for (const auto rule : {plate::FluxRule::lever, plate::FluxRule::crossing_point}) {
    const Eigen::VectorXd whole = bb::with_surface_nodes(body.solid, 1, rule, body.conditions());
    const Eigen::VectorXd half = bb::with_surface_nodes_mirrored(body.solid, 1, rule, body.conditions(), 2);
    CHECK((whole - half).cwiseAbs().maxCoeff() < 1e-9 * whole.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("loaded: errors are over the largest of each component") {
  const auto box = bb::elastic_box({3, 3, 3}, 0.1);
  const auto field = [](const Eigen::Vector3d& x) { return Eigen::Vector3d(2 * x[0], x[1], x[2]); };
  Eigen::VectorXd u = bb::at_unknowns(box, field);
  CHECK(bb::errors(box, u, field).largest == 0);
  u[0] += 0.05;  // the largest u is 0.5
  CHECK(bb::errors(box, u, field).largest == Approx(0.1));
  CHECK(bb::largest_errors(box, u, field)[0] == Approx(0.1));
  CHECK(bb::largest_errors(box, u, field)[1] == 0);
}
