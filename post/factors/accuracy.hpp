#pragma once
#include "post/factors/srif.hpp"

namespace post {

/// Step of a search over several discretisations of a plate, each finer than the one before: all lengths over those of
/// the first by `size`, those at singular points by its square, so that errors go with size^2 (theory.md, "To a stated
/// accuracy").
struct AccuracyStep {
  double size = 1;
  std::size_t points = 0;
  double spacing = 0, tip_spacing = 0;  // [length]
  std::optional<double> hole_spacing;   // [length]
  double spacing_growth = 0;
  double faces = 0;  // spacing on the faces of cracks, a clear distance from the tip [layers]
  double seconds = 0;
  std::vector<std::vector<Srif>> rows;  // by all methods, at all times; of a static case one
  std::vector<double> truncated;        // of every tip of a plate in motion: LanczosMotion::truncated()
  std::optional<double> error;  // estimated, of the worst factor of all tips, relative to the largest of its tip
  std::vector<std::vector<Srif>> rows_in_plane;  // N1 and N2 as K1 and K2, where loads act there
};

/// Rows of a step: those of bending, or those in the plane.
using RowsOfStep = std::vector<std::vector<Srif>> AccuracyStep::*;

/// The factors of every tip that the discretisations tend to, at all times, as SrifMethod::refinement, with their
/// estimated errors. Tips that do not have both integrals and the fit in each of the last three discretisations are
/// left out. No rows where no tip is left. `rows`: that are refined.
std::vector<std::vector<Srif>> refined(const std::vector<AccuracyStep>& path, double thickness,
                                       RowsOfStep rows = &AccuracyStep::rows);

/// The error of another method's factors, from those of the same tip that the discretisations tend to.
void refer_to(const Srif& refined, Srif& srif, double thickness);

/// The largest estimated error of all factors at all times, relative to the largest factor that the tip ever has, or to
/// a hundredth of what other tips have or of `nominal` where that is more: what is next to nothing need not be known.
/// Absent unless every one of `tips` has factors.
std::optional<double> largest_error(const std::vector<std::vector<Srif>>& refined, std::size_t tips, double thickness,
                                    double nominal);

/// Factors at all times, and their largest_error(); absent unless every tip has factors.
struct BestFactors {
  std::vector<std::vector<Srif>> rows;
  std::optional<double> error;
};

/// Returns the factors with the least error among those known after every discretisation of a path, as refined() gives
/// them. Errors are first widened to reach the factors of any later discretisation, one after the other, unless these
/// are within them or have more than twice the error as widened so far. Returns the last where none has factors
/// at every tip.
BestFactors best_of(std::vector<std::vector<std::vector<Srif>>> refined, std::size_t tips, double thickness,
                    double nominal);

/// States the accuracy that every tip has reached. Factors whose error is above a tenth of what it counts against are
/// not resolved.
void judge(std::vector<std::vector<Srif>>& refined, double thickness, double nominal);

}  // namespace post
