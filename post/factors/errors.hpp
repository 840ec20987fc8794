#pragma once
#include "post/factors/srif.hpp"
#include "post/factors/tip_section.hpp"

namespace post {

/// Weights of the indicators of an error in the estimated errors (theory.md, "What the estimated errors mean").
struct ErrorShares {
  double
      energy;    // of the difference between the energy release rates of the fit and of the integrals, in K1 and K2 ...
  double shear;  // ... and in K3, of the largest factor
  double fits;   // of the largest difference between fits: their turn, in K1 and K2 ...
  double fits_shear;  // ... and in K3
  double least;       // of the largest factor
  double layer;  // of the largest factor: for K3, where a spacing (or half a horizon) is as wide as the layer beside
                 // the faces
  double width;  // of that spacing [layers]
  double doubt;  // beyond this the difference between those energies counts in full, and as a turn of K1 and K2
  double faces = 0;      // spacing on the faces away from the tip [layers]
  double lost = 0.1;     // of the largest factor: an error of K3 above this leaves nothing of it
  double mixing = 0;     // of the largest factor, in K3, where the mix comes from interaction integrals
  double own_shear = 0;  // of K3 itself, times one more than the spacing on the faces [layers]
  double tied = 0;       // 1 where K3 is zero, because a shear layer holds both faces together
  double turn = 0;       // of K1 and K2 [rad]
  double sliding = 0;    // of the largest factor, added to `least` in K2
};

/// Estimates the errors of what all methods found at one tip; methods whose energy release rate is not positive are
/// marked as not resolved. `fits`: from several ranges about the tip, the one that gave the mode mix first; empty where
/// the mix comes from the opening.
void estimate_errors(std::vector<Srif>& found, const std::vector<FitSrif>& fits, const TipSection& at,
                     const ErrorShares& shares);

/// Errors of the factors of a sum of states, each times a number. The parts' own errors, as if they had nothing to do
/// with one another, are the least: where factors cancel, their errors need not. Rows of parts count where they have
/// the same tip and method. Factors in the plane are widened as those of bending.
void widen_errors(std::vector<Srif>& sum, const std::vector<std::pair<double, const std::vector<Srif>*>>& parts,
                  double thickness);

/// The largest of |K1|, |K2|, |K3| h of all tips, by the methods whose errors are estimated.
double largest_of_tips(const std::vector<Srif>& srifs, double thickness);

/// Adds to the errors of a tip 0.0007 of what the most loaded tip, with `most`, has beyond it: the error of the
/// field of the plate (theory.md, "What the estimated errors mean").
void add_errors_of_other_tips(std::vector<Srif>& srifs, double most, double thickness);

/// Marks factors by energy and by the fit whose error is above a tenth of the largest factor that their tip has had as
/// not resolved. `largest`: of every tip, by largest_with_plane(), of the rows before; brought up to date.
void mark_lost(std::vector<Srif>& srifs, double thickness, std::vector<double>& largest);

}  // namespace post
