// The clamped plate of Sca21 6.2 by Lagrange multipliers; local reference by Ritz's method.

#include "cases/papers/bodies/clamped_plate.hpp"
#include "tests/catch.hpp"

namespace bb = boundary_bodies;
using bb::Solid;

TEST_CASE("clamped plate of Sca21 6.2: the reference is there to four figures") {
  const bb::RitzClampedPlate fine(12), coarse(9);
  double off = 0, size = 0;
  const Solid s = bb::clamped_plate();
  for (int k = 0; k < s.body.real; ++k) {
    off = std::max(off, (fine(s.at(k)) - coarse(s.at(k))).norm());
    size = std::max(size, fine(s.at(k)).norm());
  }
  CHECK(off < 1e-4 * size);  // measured: 2.2e-5
}

TEST_CASE("clamped plate of Sca21 6.2: errors fall with the order, from 1.5 % to the 0.5 % of a finite horizon") {
  const Solid s = bb::clamped_plate();
  const bb::RitzClampedPlate reference(12);
  const auto none = bb::clamped_errors(s, bb::uncorrected_clamped(s, reference), reference);
  CHECK((none - Eigen::Array2d(7.430, 1.002)).abs().maxCoeff() < 0.005);  // u, v in percent of the largest displacement
  const std::vector<Eigen::Array2d> expected{
      {1.471, 1.479}, {0.587, 0.519}, {0.487, 0.245}, {0.488, 0.222}, {0.490, 0.219}};
  const Eigen::VectorXd converged = bb::clamped_by_multipliers(s, 5);
  double before = 1e9;
  for (int order = 1; order <= 5; ++order) {
    const Eigen::VectorXd u = bb::clamped_by_multipliers(s, order);
    CHECK((bb::clamped_errors(s, u, reference) - expected[std::size_t(order - 1)]).abs().maxCoeff() < 0.002);
    const double left = (u - converged).cwiseAbs().maxCoeff() / converged.cwiseAbs().maxCoeff();
    if (order < 5) CHECK(left < 0.6 * before);  // measured: 0.40, 0.23, 0.31
    before = left;
  }
}
