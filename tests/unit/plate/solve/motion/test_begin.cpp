#include "plate/solve/motion/initial_conditions.hpp"

#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/motion/time_grid.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;

TEST_CASE(
    "a motion does not begin with what jumps, or what a support does not allow, with a velocity or a wave it does") {
  for (const auto* kind : {&galerkin, &ordinary}) {
    auto c = vp::square(0.125);
    c.discretization.formulation = kind;
    c.supports = {vp::held(SupportKind::simply_supported, {"left"})};
    const auto begin = [&](const std::string& deflection) {
      c.initial = Initial{Formula(deflection), {}};
      return begin_of_motion(*vp::assembled(c), 1);
    };
    for (const char* jumps : {"x < 0.03 ? 0 : 0.1", "y < 0 ? 0.2 : 0.1", "0.1", "x + 1.5"})
      CHECK_THROWS_AS(begin(jumps), Jumps);
    for (const char* bends : {"x + 1", "sin(3 * (x + 1)) * cos(5 * y)", "(x + 1) ^ 2", "0"})
      CHECK_NOTHROW(begin(bends));
  }
}

TEST_CASE("a motion begins with an expression, its slopes, and the energies of both") {
  for (const auto* kind : {&galerkin, &ordinary}) {
    auto c = vp::square(0.125);
    c.discretization.formulation = kind;
    CHECK(begin_of_motion(*vp::assembled(c), 1).deflected.size() == 0);
    c.initial = Initial{Formula("0.2 * x * x + 0.3 * y"), Formula("4")};
    c.impact = Impact{{0.3, -0.2}, 2, -3, 70};
    const auto plate = vp::assembled(c);
    const auto begin = begin_of_motion(*plate, 1);
    for (std::size_t k = 0; k < plate->cloud().plate_points; ++k) {
      const auto& x = plate->cloud().positions[k];
      const Eigen::Vector3d u(0.2 * x.x() * x.x() + 0.3 * x.y(), 0.3, -0.4 * x.x());
      CHECK((begin.deflected.col(Eigen::Index(k)) - u).norm() < 1e-9);
      CHECK((begin.velocity.col(Eigen::Index(k)) - Eigen::Vector3d(4, 0, 0)).norm() < 1e-9);
    }
    const double mass = c.section.density * c.section.thickness * 4;
    const double bent = plate->strain_energy(begin.deflected);
    const double exact = c.section.bending_stiffness() * 0.16 / 2 * 4;      // kappa_xx = -0.4
    CHECK(bent == Approx(exact).epsilon(kind == &galerkin ? 1e-6 : 2e-3));  // measured: 1e-9, 1.3e-3 of bonds
    CHECK(begin.given == Approx(bent + mass * 16 / 2 + 2 * 9 / 2.0).epsilon(1e-9));
    Analysis analysis;
    const double free = 1e-3;
    CHECK(stable_step(free, *plate, analysis, begin) < free);
    CHECK(stable_step(free, *plate, analysis, {}) == free);
    analysis.damping = Damping{0, 2e-3};
    CHECK(stable_step(free, *plate, analysis, {}) == Approx(std::hypot(2e-3, 1e-3) - 2e-3));
    analysis.duration = 1;
    CHECK(damped_step(free, *plate, analysis, {}).limit == free / 2);
    CHECK(damped_step(free, *plate, analysis, {}).relaxation == Approx(2e-3 / 3));
    analysis.time_step = 1e-4;  // needs no relaxation
    CHECK(damped_step(free, *plate, analysis, {}).relaxation == 0);
    c.initial->velocity = Formula("1 / (x - 0.0625)");
    if (kind == &ordinary) CHECK_THROWS_AS(begin_of_motion(*vp::assembled(c), 1), FormulaError);
  }
}
