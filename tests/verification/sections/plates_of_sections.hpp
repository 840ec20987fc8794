#pragma once

#include "plate/formulation/interpolation.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/solve/statics.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

/// Galerkin plates of any section.
namespace plates_of_sections {

using namespace plate;
namespace vp = verified_plate;
using geometry::Point;

/// E2 = 1000; G12 = G13 = E2 / 2, G23 = E2 / 5, as of unidirectional laminae.
inline Section orthotropic(double ratio, double thickness, double angle = 0) {
  Section s{0, 0, thickness, 5.0 / 6, 2};
  s.orthotropic = {ratio * 1000, 1000, 0.25, 500, 500, 200, angle};
  return s;
}

inline cases::Case rectangle(const Section& section, double a, double b, double spacing) {
  auto c = vp::free_plate(geometry::rectangle(0, 0, a, b), spacing);
  c.discretization.formulation = &galerkin;
  c.section = section;
  return c;
}

inline State at_rest(const Formulation& plate) {
  const auto found =
      solve_static(plate, plate.total_load(), StaticMethod::cg, Preconditioning::automatic, {1e-10, 20000, {}});
  REQUIRE(found.solution.converged);
  return found.solution.state;
}

inline double at(const Formulation& plate, const State& u, const Point& x) {
  double sum = 0;
  for (const auto& share : plate.interpolation(x)) sum += share.weight * u(0, share.point);
  return sum;
}

inline Load uniform_pressure() {
  return {Pressure{.value = 1}};
}

}  // namespace plates_of_sections
