#include "cases/input/keys.hpp"
#include "cases/input/keys/places.hpp"
#include "plate/model/elastic/elastic_supports.hpp"

namespace cases {

Fields<plate::Foundation> foundation_fields() {
  using F = plate::Foundation;
  return {
      number<F>("modulus", "force/length^3", &F::modulus, positive, "what w is answered with (Winkler)").required(),
      number<F>("shear", "force/length", &F::shear, {0}, "the shear layer on top of it (Pasternak)"),
      table<F, geometry::Hole>("on", Layout::inline_, &F::patch,
                               hole_fields("the disc that lies on the foundation, without it the plate",
                                           "the polygon that lies on the foundation, without it the plate"),
                               check_hole),
      value<F>(
          {"lifts_off", "-", "true or false", "false",
           "the plate may lift off: it is pressed along w where w < 0, and nowhere pulled"},
          [](const Value& given, F& f) { f.lifts_off = given.boolean().value_or(false); },
          [](const F& f) { return std::string(f.lifts_off ? "true" : "false"); }),
  };
}

Fields<plate::Spring> spring_fields() {
  using S = plate::Spring;
  const auto position = value<S>(
      {"position", "length", "[x, y] in the plate", "", "where one spring stands"},
      [](const Value& given, S& spring) { spring.position = given.point(); },
      [](const S& s) { return s.position ? text_of(*s.position) : ""; });
  return {
      edges<S>("the edges that springs hold: these, along or position"),
      points("along", &S::along, 2, "a line in the plate that springs hold"),
      position,
      number<S>("deflection", "force/length^2, at a position force/length", &S::deflection, {0}, "against w"),
      number<S>("rotation_normal", "force", &S::rotation_normal, {0},
                "edges, along: against the rotation along the normal, with which the plate bends"),
      number<S>("rotation_tangential", "force", &S::rotation_tangential, {0},
                "edges, along: against the rotation along the edge or line, with which the plate twists"),
      number<S>("rotation", "force length", &S::rotation, {0}, "position: against both rotations"),
  };
}

Fields<plate::Stiffener> stiffener_fields() {
  using S = plate::Stiffener;
  return {
      edges<S>("the edges that the beam runs along: these or along"),
      points("along", &S::along, 2, "the line in the plate that the beam runs along"),
      number<S>("bending", "force length^2", &S::bending, {0}, "EI, against the curvature along the beam"),
      number<S>("torsion", "force length^2", &S::torsion, {0}, "GJ, against the twist along the beam"),
      number<S>("shear", "force", &S::shear, positive, "k G A; without it the beam does not shear"),
      number<S>("mass", "mass/length", &S::mass, {0}, "of the beam: in motion, frequencies and own weight"),
  };
}

}  // namespace cases
