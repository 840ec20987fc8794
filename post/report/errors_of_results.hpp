#pragma once
#include "post/files/summary.hpp"

namespace post {

/// Diameter and thickness of a plate [length].
struct PlateSizes {
  double diameter, thickness;
};

/// Sets the estimated errors of the results of a plate at rest, or of its frequencies: the share of the difference from
/// those of other points. Two values may agree by chance, so that deflections, rotations and strain energy have at
/// least the largest relative difference among them, and so have reactions, forces in the plane, moments; a frequency
/// has at least that of the modes below.
void set_errors(Summary& summary, const OtherResults& other, const PlateSizes& sizes);

}  // namespace post
