#pragma once
#include "post/srif.hpp"

namespace post {

/// What the estimates of the errors count of each sign of an error (theory.md, "What the estimated errors mean").
struct ErrorShares {
  double energy;  // of the difference between the energy release rates of the fit and of the integrals, in K
  double fits;    // of the largest difference between fits
  double least;   // of the largest factor
  double layer;   // of the largest factor: for K3, where a spacing (or half a horizon) is as wide as the layer beside the faces
  double width;   // of that spacing [layers]
};

/// Estimates the errors of what all methods found at one tip, and marks factors that are not resolved. `fits`: from several ranges about the
/// tip, the one that gave the mode mix first; empty where the mix comes from the opening.
void estimate_errors(std::vector<Srif>& found, const std::vector<FitSrif>& fits, const plate::Section& section,
                     const ErrorShares& shares);

}  // namespace post
