#include "cases/papers/bodies/boxes.hpp"

#include "tests/catch.hpp"

namespace bb = boundary_bodies;

TEST_CASE("boxes: the made-up tractions and loads are in equilibrium as a whole") {
  // forces on all faces and inside, by the midpoint rule, exact for these polynomials but for x^2 on the long faces
  const bb::MadeBox body({8, 8, 4});
  const auto& s = body.solid;
  const auto conditions = body.conditions();
  Eigen::Vector3d sum(0, 0, 0), size(0, 0, 0);
  for (int i = 0; i < int(s.body.surface.size()); ++i) {
    const auto& face = s.body.surface[std::size_t(i)];
    const Eigen::Vector3d f =
        s.area() * conditions.traction(s.at_surface(i), face.side * Eigen::Vector3d::Unit(face.axis));
    sum += f, size += f.cwiseAbs();
  }
  for (int k = 0; k < s.body.real; ++k) sum += s.volume() * conditions.load(s.at(k));
  CHECK(sum.cwiseAbs().maxCoeff() < 1e-9 * size.maxCoeff());
}

TEST_CASE("boxes: the lattice's field is near the local one when pulled, and not the same") {
  const auto box = bb::elastic_box({4, 3, 3}, 0.1);
  const auto u = bb::at_unknowns(box, bb::pulled_box_of_lattice(box));
  const double off = bb::errors(box, u, bb::pulled_box).largest;
  CHECK((off > 1e-5 && off < 2e-3));
}
