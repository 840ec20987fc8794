#pragma once
#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/crack_path.hpp"
#include "geometry/shape/outline.hpp"

namespace plate {

/// What a plate lies on: soil that answers the deflection w with the pressure -k w + G_p laplace(w) (Winkler 1867;
/// Pasternak 1954).
struct Foundation {
  double modulus = 0;                   // k [force/length^3]
  double shear = 0;                     // G_p [force/length]
  std::optional<geometry::Hole> patch;  // under this part of the plate alone
  bool lifts_off = false;               // presses along +w where w < 0, and does not pull
};

/// Springs along edges, along a line, or one at a point: of these three one is given.
struct Spring {
  double deflection = 0;           // against w: [force/length^2], of one [force/length]
  double rotation_normal = 0;      // against psi_n, which bends: [force]; n the normal of the edge or line
  double rotation_tangential = 0;  // against psi_s, which twists: [force]
  double rotation = 0;             // of one, against both rotations [force length]
  std::vector<std::string> edges;
  geometry::Polyline along;
  std::optional<geometry::Point> position;
};

/// A beam in the middle plane along edges or a line, tied to the plate's deflection and rotations: it bends and twists
/// with the plate, and takes no force along itself.
struct Stiffener {
  double bending = 0;           // EI [force length^2]
  double torsion = 0;           // GJ [force length^2]
  std::optional<double> shear;  // k G A [force]; without it the beam's slope is the plate's (Bernoulli)
  double mass = 0;              // rho A [mass/length]
  std::vector<std::string> edges;
  geometry::Polyline along;
};

}  // namespace plate
