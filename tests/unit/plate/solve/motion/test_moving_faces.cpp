#include "plate/solve/motion/moving_faces.hpp"

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/motion/stretched_motion.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace plate;

namespace {

Discretised cracked(const std::string& cracks, const std::string& formulation = "galerkin") {
  return discretise(
      case_text::read(case_text::plain, {"geometry.cracks=" + cracks, "cracks.contact=true",
                                         "discretization.spacing=0.1", "discretization.formulation=" + formulation,
                                         "section.density=1", "analysis={kind=\"dynamic\",duration=1}"})
          .content);
}

/// Velocities that open and close cracks somehow.
State waves(const StretchedMotion& both) {
  State result = zero_state(both.points());
  for (Eigen::Index k = 0; k < result.cols(); ++k)
    result.col(k) << 0, std::sin(double(7 * k)), std::cos(double(11 * k));
  both.constraints().impose(result);
  return result;
}

}  // namespace

TEST_CASE("moving faces: forces keep the next openings from being negative, and do not pull") {
  const auto cracks =
      GENERATE(as<std::string>(), "[[[-0.31,0.02],[0.33,0.1]]]", "[[[-1.0,0.1],[0.2,0.15]]]",
               "[[[-0.4,-0.3],[0.0,0.05],[0.4,0.3]]]", "[[[-0.5,0.0],[0.5,0.0]],[[0.0,-0.5],[0.0,0.5]]]",
               "[[[-0.5,0.0],[0.5,0.0]],[[0.0,0.0],[0.2,0.5]]]");
  const auto formulation = GENERATE(as<std::string>(), "galerkin", "ordinary");
  CAPTURE(cracks, formulation);
  const auto plates = cracked(cracks, formulation);
  const StretchedMotion both(*plates.plate, *plates.membrane, 1);
  REQUIRE(both.faces().pairs.size() == plates.plate->face_pairs().size());
  const Forces mass = both.mass();
  const State rest = zero_like(mass), velocity = waves(both);
  MovingFaces faces(both.faces(), {});
  Forces forces = zero_like(mass);
  constexpr double dt = 0.01;
  faces.press({.state = rest,
               .velocity = velocity,
               .time_step = dt,
               .share = dt,
               .drag = 1,
               .acceleration = [](const Dof&) { return 0.0; },
               .first = false},
              forces);
  State after = rest;
  for (Eigen::Index i = 0; i < mass.size(); ++i)
    if (mass.data()[i] > 0) after.data()[i] = dt * (velocity.data()[i] + dt * forces.data()[i] / mass.data()[i]);
  both.constraints().impose(after);
  std::size_t pressed = 0;
  for (std::size_t i = 0; i < both.faces().pairs.size(); ++i) {
    AtFaces opening{};
    for (const auto& [number, shares] : both.faces().pairs[i].terms)
      for (const int face : {0, 1}) opening[face] += shares[face] * at_dof(after, *both.faces().dofs[number]);
    const auto& force = faces.contacts()[i].force;
    for (const int face : {0, 1}) {
      CHECK(opening[face] > -1e-12 * dt);
      CHECK(force[face] >= 0);
      CHECK((force[face] == 0 || std::abs(opening[face]) < 1e-11 * dt));
      pressed += force[face] > 0;
    }
  }
  CHECK(pressed > 1);
  CHECK(pressed < 2 * both.faces().pairs.size());
  CHECK(faces.so_far().lost == Approx(-dt / 2 * forces.cwiseProduct(velocity).sum()));
}

TEST_CASE("moving faces: a motion goes on from between two steps with the same numbers") {
  const auto plates = cracked("[[[-0.31,0.02],[0.33,0.1]]]");
  const StretchedMotion both(*plates.plate, *plates.membrane, 1);
  DynamicOptions options;
  options.time_step = 0.9 * stable_time_step(*plates.plate, *plates.membrane, 1);
  options.steps = 60, options.velocity = waves(both), options.faces = both.faces();
  MotionCheckpoint half;
  options.due = [] { return true; };
  options.save = [&](const MotionCheckpoint& now) {
    if (now.step == 30) half = now;
  };
  State end[2];
  ContactSoFar contact[2];
  for (const int run : {0, 1}) {
    if (run == 1) options.from = &half, options.save = {};
    central_differences(both, both.constraints(), both.mass(), both.loads(), options,
                        [&](const Instant& now) { end[run] = now.state, contact[run] = now.contact_so_far; });
  }
  CHECK(end[0] == end[1]);
  CHECK(contact[0].lost > 0);
  CHECK(contact[0].lost == contact[1].lost);
  CHECK(contact[0].least_opening == contact[1].least_opening);
}
