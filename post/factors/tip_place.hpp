#pragma once
#include "geometry/shape/crack_path.hpp"
#include "plate/formulation/tip_view.hpp"

namespace post {

using plate::TipFrame;

/// Surroundings of a tip.
struct TipPlace {
  geometry::Tip tip;
  geometry::CrackPath path;
  double clear;            // clear_distance, less where loads and pins stand nearer [length]
  double narrowest;        // the least of `clear` of all tips: what is not resolved there errs everywhere [length]
  double undisturbed;      // to the next load, pin or spring; no more than foundations reach [length]
  double faces;            // spacing of the points on the faces, where `clear` ends [length]
  bool heated = false;     // by temperatures that vary over the plate
  bool tied = false;       // a shear layer below holds the deflections of both faces together
  TipFrame frame{tip};     // of the crack behind the tip
  double known_error = 0;  // of all factors, whatever the field about the tip says, as a share of the largest
};

}  // namespace post
