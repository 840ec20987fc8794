#pragma once
#include <optional>
#include "plate/formulation/parts/pieces.hpp"
#include "plate/model/state.hpp"

namespace plate {

/// A part of the plate that moves without resistance against the part that it hangs on.
struct LoosePart {
  std::size_t points = 0;
  geometry::Point position{0, 0};  // of its first point [length]
  geometry::Point ligament{0, 0};  // a point of the line that it turns about [length]
};

/// What no bond resists although every piece is held. A bond ties two points together but for the turn about its own
/// line, so that bonds along one line, a ligament one row of points wide, are a hinge.
struct Mechanisms {
  std::size_t twisting = 0;          // points whose bonds all lie on one line: their turn about it has no stiffness
  std::optional<LoosePart> twisted;  // one of them that the load turns
  int motions = 0;                   // of whole parts against each other
  std::optional<LoosePart> driven;   // the largest part that the load sets in motion
  std::size_t parts = 0;             // rigid in themselves
  bool searched = true;              // false: too many parts to look for motions, or several processes share them
};

/// `pieces` of the same plate; `load` of all points, as nodal forces.
Mechanisms mechanisms(const Boundary& boundary, const geometry::Families& families, const std::vector<Piece>& pieces,
                      const Forces& load);

/// Ties the turn of every point about the line of its bonds to that of the next point that has bonds in two directions,
/// so that it moves with the plate and has no motion of its own. Changes no other point. Of one process.
void tie_twists(Boundary& boundary, const geometry::Families& families);

}  // namespace plate
