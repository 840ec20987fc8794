#pragma once
#include "post/files/summary.hpp"

namespace plate {
struct Problem;
}

namespace post {

/// Diameter and thickness of a plate [length].
struct PlateSizes {
  double diameter, thickness;
  double soft_edges = 0;  // error_of_soft_edges()
};

/// Least error of reactions, relative to the largest, where edges are softly supported: beside these twist and shear
/// change within a layer that is as wide as the points where these are farther apart than the plate is thick.
double error_of_soft_edges(const plate::Problem& problem);

/// Sizes of a plate, and of the layers beside its edges.
PlateSizes sizes_of(const plate::Problem& problem);

/// Sets the estimated errors of the results of a plate at rest, or of its frequencies: the share of the difference from
/// those of other points. Two values may agree by chance, so that deflections, rotations and strain energy have at
/// least the largest relative difference among them, and so have reactions, forces in the plane, moments; a frequency
/// has at least that of the other modes, less of those above. Errors that are there already do not get less.
void set_errors(Summary& summary, const OtherResults& other, const PlateSizes& sizes);

}  // namespace post
