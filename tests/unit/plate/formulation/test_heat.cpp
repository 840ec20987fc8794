#include "plate/formulation/thermal_curvature.hpp"

#include "plate/formulation/formulation.hpp"
#include "plate/formulation/sections.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;

namespace {

cases::Case heated(const FormulationKind& kind) {
  auto c = vp::free_plate(geometry::rectangle(0, 0, 1, 1), 0.125);
  c.discretization.formulation = &kind;
  c.section = {1000, 0.3, 0.1, 5.0 / 6, 2, 0.01};
  const Load pressure{Pressure{.value = 3}}, first{Temperature{.value = 20}};
  Load second{Temperature{.formula = Formula("10 * x - 5 * y")}};
  second.history.kind = History::Kind::ramp, second.history.rise_time = 4;
  c.loads = {pressure, first, second};
  return c;
}

}  // namespace

TEST_CASE("heat: temperatures times their shares, and nothing of other loads") {
  for (const auto* kind : {&galerkin, &ordinary}) {
    const auto plate = vp::assembled(heated(*kind));
    CHECK(heat_of(*plate, {1, 0, 0}).none());
    const auto both = heat_of(*plate, {1, 2, -1}), later = heat_at(*plate, 1), whole = heat_of(*plate, 1);
    for (std::size_t k = 0; k < plate->cloud().plate_points; ++k) {
      const auto& x = plate->cloud().positions[k];
      const double varying = 10 * x.x() - 5 * x.y();
      CHECK(both.curvature[Eigen::Index(k)] == Approx(0.1 * (40 - varying)));
      CHECK(later.curvature[Eigen::Index(k)] == Approx(0.1 * (20 + varying / 4)));
      CHECK(whole.curvature[Eigen::Index(k)] == Approx(0.1 * (20 + varying)));
    }
    CHECK(stored(*plate, {}, State::Ones(3, 4)) == 0);
    CHECK(stored(*plate, both, State::Zero(3, Eigen::Index(plate->points()))) > 0);
  }
}

TEST_CASE("heat: its forces are the derivative of the energy of kappa - kappa_0, and resist no rigid motion") {
  for (const auto* kind : {&galerkin, &ordinary}) {
    const auto plate = vp::assembled(heated(*kind));
    const auto heat = heat_of(*plate, 1);
    const auto zero = [](const geometry::Point& x) { return Eigen::Vector3d(2 + 3 * x.x() - x.y(), -1, -3); };
    CHECK(std::abs(heat.forces.cwiseProduct(vp::field(*plate, zero)).sum()) < 1e-12 * heat.forces.norm());
    // the energy of the free paraboloid about any place is that of kappa - kappa_0 = (kappa - kappa_0 there)
    const State flat = State::Zero(3, Eigen::Index(plate->points()));
    const auto bent = cold(flat, plate->cloud().positions, {0.3, 0.4}, -1.7);  // kappa = 1.7 everywhere
    double expected = 0;
    for (std::size_t k = 0; k < plate->cloud().plate_points; ++k)
      expected += plate->cloud().areas[k] * std::pow(1.7 - heat.curvature[Eigen::Index(k)], 2);
    expected *= plate->section().bending_stiffness() * 1.3;
    CHECK(plate->strain_energy(bent) + stored(*plate, heat, bent) == Approx(expected).epsilon(1e-10));
  }
}

TEST_CASE("heat: moments are less by D (1 + nu) kappa_0, and so are the stresses") {
  const auto plate = vp::assembled(heated(galerkin));
  const auto u = vp::random_state(*plate, 3);
  const auto before = plate->resultants(u);
  auto after = before;
  const auto heat = heat_of(*plate, 1);
  relieve(after, plate->section(), heat);
  const double D = plate->section().bending_stiffness();
  for (Eigen::Index k = 0; k < after.moments.cols(); ++k) {
    const Eigen::Vector3d m = before.moments.col(k) - D * 1.3 * heat.curvature[k] * Eigen::Vector3d(1, 1, 0);
    CHECK((after.moments.col(k) - m).norm() < 1e-12 * m.norm());
    const double most = 6 / 0.01 * std::sqrt(m[0] * m[0] - m[0] * m[1] + m[1] * m[1] + 3 * m[2] * m[2]);
    CHECK(after.von_mises[k] == Approx(most));
  }
  CHECK(after.shear == before.shear);
}
