#pragma once

#include "plate/formulation/operator.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/solve/statics.hpp"
#include "tests/catch.hpp"
#include "tests/verification/at_rest.hpp"
#include "tests/verification/verified_plate.hpp"

/// Galerkin plates of any section.
namespace plates_of_sections {

using namespace plate;
namespace vp = verified_plate;
using geometry::Point, vp::at, vp::at_rest;

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

inline Load uniform_pressure() {
  return {Pressure{.value = 1}};
}

}  // namespace plates_of_sections
