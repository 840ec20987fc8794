#include "plate/formulation/foundations.hpp"

#include "tests/catch.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;

namespace {

constexpr Eigen::Index contact_points = 6;

/// Two places that share a degree of freedom, and one of its own.
Contact contact() {
  return Contact({{4, {{2, 1}, {9, -0.5}}}, {3, {{2, 1}}}, {2, {{17, 1}}}});
}

State random(unsigned seed) {
  std::srand(seed);
  return State::Random(3, contact_points);
}

}  // namespace

TEST_CASE("the force of soil that lifts off is the slope of its energy, and pulls nowhere") {
  const auto soil = contact();
  for (unsigned seed = 1; seed < 8; ++seed) {
    const State u = random(seed);
    Forces force = Forces::Zero(3, contact_points);
    soil.add_force(1, u, force);
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      State more = u, less = u;
      more.data()[i] += 1e-6, less.data()[i] -= 1e-6;
      CHECK(force.data()[i] == Approx(-(soil.energy(more) - soil.energy(less)) / 2e-6).margin(1e-8));
    }
    CHECK(soil.energy(u) == Approx(-force.cwiseProduct(u).sum() / 2).margin(1e-14));
    const auto touching = soil.touching(u);
    CHECK(bool(touching[1]) == (u.data()[2] < 0));
    Forces same = Forces::Zero(3, contact_points);
    soil.add_force(1, u, touching, same);
    CHECK((same - force).norm() < 1e-14);
    Values<float> single = u.cast<float>(), of_single = Values<float>::Zero(3, contact_points);
    soil.add_force(1, single, of_single);
    CHECK((of_single.cast<double>() - force).norm() < 1e-6);
  }
}

TEST_CASE("what touches is counted by its stiffness") {
  State u = State::Zero(3, contact_points);
  u.data()[2] = -1, u.data()[17] = 1;
  double touching = 0, all = 0;
  contact().for_each(
      u, [&](std::size_t, double stiffness, bool touches) { all += stiffness, touching += touches ? stiffness : 0; });
  CHECK(touching == 7);
  CHECK(all == 9);
  CHECK(contact().places() == 3);
}
