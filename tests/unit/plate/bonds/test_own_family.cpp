#include "plate/bonds/family_weights.hpp"

#include "tests/catch.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;

namespace {

/// Three bonds about point 1 of four.
OwnFamily family() {
  OwnFamily result{1, 0.3, -2, {}};
  const std::array<geometry::Point, 3> vectors{{{1, 0}, {0.6, 0.8}, {-0.5, 1.5}}};
  std::uint32_t neighbour = 0;
  for (const auto& x : vectors) {
    const double length = x.norm();
    result.bonds.push_back({neighbour == 1 ? ++neighbour : neighbour,
                            x.y() / length,
                            -x.x() / length,
                            length,
                            {0.5 + length, 3 - length, 7 * length}});
    ++neighbour;
  }
  return result;
}

}  // namespace

TEST_CASE("own family: its energy is a symmetric form, and its force minus the derivative of that") {
  const auto one = family();
  const State u = small_plate::random_state(4, 1), v = small_plate::random_state(4, 2);
  CHECK(energy(one, u, v) == Approx(energy(one, v, u)));
  CHECK(energy(one, u + v, u + v) == Approx(energy(one, u, u) + 2 * energy(one, u, v) + energy(one, v, v)));
  Forces force = Forces::Ones(3, 4);
  add_force(one, u, 0.25, force);
  force.array() -= 1;
  CHECK(-force.cwiseProduct(v).sum() / 0.25 ==
        Approx((energy(one, u + v, u + v) - energy(one, u - v, u - v)) / 2));  // it is quadratic
}

TEST_CASE("own family: a rigid motion stores nothing, and forces and couples are in balance") {
  const auto one = family();
  const std::array<geometry::Point, 4> x{{{1, 0}, {0, 0}, {0.6, 0.8}, {-0.5, 1.5}}};
  State rigid(3, 4);
  for (Eigen::Index k = 0; k < 4; ++k) rigid.col(k) << 5 - 3 * x[std::size_t(k)].x() + 2 * x[std::size_t(k)].y(), 2, 3;
  CHECK(energy(one, rigid, rigid) == Approx(0).margin(1e-28));
  Forces force = Forces::Zero(3, 4);
  add_force(one, small_plate::random_state(4, 3), 1, force);
  for (const auto& [c, a, b] : {std::array{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}) {
    State motion(3, 4);
    for (Eigen::Index k = 0; k < 4; ++k)
      motion.col(k) << c - b * x[std::size_t(k)].x() + a * x[std::size_t(k)].y(), a, b;
    CHECK(force.cwiseProduct(motion).sum() == Approx(0).margin(1e-13));
  }
}
