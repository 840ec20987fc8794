#include "plate/solve/motion/stretched_motion.hpp"

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;

namespace {

/// A square that is held at its left edge, pulled at the right one, and pressed.
cases::Case pulled(bool stretches) {
  auto c = vp::square(0.25);
  c.discretization.formulation = &galerkin;
  c.supports = {vp::held(SupportKind::clamped, {"left"})};
  c.supports[0].in_plane = InPlane::fixed;
  c.loads = {{Pressure{1}}, {EdgeTraction{{"right"}, 2}}};
  c.stretches = stretches;
  return c;
}

State random_of(const StretchedMotion& both, unsigned seed) {
  std::srand(seed);
  State result = 0.1 * State::Random(3, Eigen::Index(both.points()));
  both.constraints().impose(result);
  return result;
}

}  // namespace

TEST_CASE("stretched motion: without large deflections both parts move as each does alone") {
  const auto plates = discretise(pulled(false));
  const StretchedMotion both(*plates.plate, *plates.membrane, 1);
  CHECK(both.stretching() == nullptr);
  CHECK(both.points() == 2 * plates.plate->points());
  const State state = random_of(both, 3);
  Forces force, of_bending, of_membrane;
  both.internal_force(state, force);
  plates.plate->internal_force(of_plate(state), of_bending);
  plates.membrane->internal_force(of_plane(state), of_membrane);
  CHECK(force == stacked(of_bending, of_membrane));
  CHECK(both.diagonal() == stacked(plates.plate->diagonal(), plates.membrane->diagonal()));
  CHECK(both.strain_energy(state) ==
        Approx(plates.plate->strain_energy(of_plate(state)) + plates.membrane->strain_energy(of_plane(state))));
  const double limit = stable_time_step(*plates.plate, 1);
  CHECK(stable_time_step(*plates.plate, *plates.membrane, 1) <= limit);

  const Forces mass = both.mass();
  CHECK(of_plate(mass) == plates.plate->mass(1));
  CHECK(of_plane(mass).row(0).isZero(0));
  const double whole = 4 * plates.plate->section().mass();
  CHECK(of_plane(both.unconstrained_mass()).row(1).sum() == Approx(whole));
  CHECK(of_plane(both.unconstrained_mass()).row(2).sum() == Approx(whole));
  for (const auto& held : plates.membrane->constraints().held()) CHECK(at_dof(of_plane(mass), held) == 0);

  const auto loads = both.loads();
  REQUIRE(loads.size() == 2);
  CHECK(of_plane(loads[0].forces).isZero(0));
  CHECK(of_plate(loads[1].forces).isZero(0));
  CHECK(of_plane(loads[1].forces).row(2).sum() == Approx(4));
  CHECK(both.load_in_plane(1) == of_plane(loads[1].forces));
  cases::Analysis analysis;
  analysis.kind = cases::Analysis::Kind::dynamic;
  const State rest = both.at_rest(analysis);
  CHECK(of_plate(rest).row(0).maxCoeff() > 0);
  CHECK(of_plane(rest).row(2).maxCoeff() > 0);
}

TEST_CASE("stretched motion: forces of large deflections are the derivative of the strain energy") {
  constexpr double step = 1e-5;
  const auto plates = discretise(pulled(true));
  const StretchedMotion both(*plates.plate, *plates.membrane, 1);
  const State state = random_of(both, 5), change = random_of(both, 6);
  Forces force;
  both.internal_force(state, force);
  const double slope =
      (both.strain_energy(state + step * change) - both.strain_energy(state - step * change)) / (2 * step);
  CHECK(force.cwiseProduct(change).sum() == Approx(-slope).epsilon(1e-6));
  CHECK(stable_time_step(*plates.plate, *plates.membrane, 1) < 0.91 * stable_time_step(*plates.plate, 1));

  State bent = zero_state(plates.plate->points());
  for (std::size_t k = 0; k < plates.plate->points(); ++k)
    bent(0, Eigen::Index(k)) = 0.05 * std::pow(plates.plate->cloud().positions[k].x() + 1, 2);
  plates.plate->constraints().impose(bent);
  const State begin = both.deflected(bent);
  CHECK(of_plate(begin) == bent);
  both.internal_force(begin, force);
  both.constraints().fold(force);
  Forces flat;
  both.internal_force(stacked(bent, zero_like(bent)), flat);
  CHECK(of_plane(force).norm() < 1e-8 * of_plane(flat).norm());
  CHECK(both.energy_in_plane(begin) < both.energy_in_plane(stacked(bent, zero_like(bent))));
}
