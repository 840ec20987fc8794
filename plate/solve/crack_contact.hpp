#pragma once
#include <vector>

#include "plate/formulation/formulation.hpp"
#include "plate/model/state.hpp"

namespace plate {

/// Opening and contact force of two points that face each other on a crack. Top is z = h/2.
struct FaceContact {
  geometry::Point position;
  double length;                       // of the crack that they stand for [length]
  double opening_top, opening_bottom;  // of the crack at both faces of the plate [length]
  double force_top, force_bottom;      // that presses there, along the crack [force/length]
};

/// Linear equilibrium of a plate and of the same plate in its plane, of which the faces of cracks touch without
/// friction.
struct TouchingFaces {
  State bending, membrane;  // change by the contact
  std::vector<FaceContact> faces;
  std::size_t factor_bytes = 0;

  double least_opening() const;  // [length]
  double largest_force() const;  // along the crack [force/length]
  /// The pair nearest to a tip; null where there is none.
  const FaceContact* next_to(const geometry::Point& tip) const;
  double length() const;        // of all cracks [length]
  double closed_share() const;  // of the length of the cracks, at one face of the plate or at both
};

/// Lever of the forces at the faces of the plate about its middle plane: half the thickness, where two thicknesses meet
/// half the smaller one [length].
double lever_of(const FacePair& pair, const PointSections& sections);

/// Equilibria of a plate and of the same plate in its plane without contact.
struct FreeFaces {
  const State &bending, &membrane;
};

/// Finds where faces of cracks touch. They stay straight through the thickness, so that their opening at z = -h/2 and
/// h/2 is that of the plane less and plus h/2 times that of the rotations. Both openings and the forces that press
/// there are not negative, and one of them is zero (theory.md, "Faces that touch"). `free`: equilibria
/// without contact.
/// @throws NumericalError  where the factor of the stiffness, or the search for what touches, fails
TouchingFaces touching_faces(const Formulation& plate, const Formulation& membrane, const FreeFaces& free);

}  // namespace plate
