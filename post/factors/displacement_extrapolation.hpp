#pragma once
#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "geometry/shape/crack_path.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/model/section.hpp"
#include "plate/model/state.hpp"
#include "post/factors/srif.hpp"

namespace post {

/// The numbers that displacement extrapolation needs of a plate.
struct PlateScale {
  plate::Section section;
  double spacing, horizon;  // [length]
  bool points_on_faces = false;
};

/// Samples that a fit of the opening takes, and terms that it fits.
struct OpeningFit {
  SrifMethod method;
  double window;                     // samples up to this distance from the tip [length]
  int skip = 0;                      // samples next to the tip left out
  int rows = 1;                      // rows of points on each side: 1 nearest row, 2 extrapolated to the crack
  int degree = 1;                    // of the polynomial K(r)
  bool tip_between_columns = false;  // a tip between two columns of points counts as half way
  bool points_on_faces = false;      // samples there, from 2.5 spacings behind the tip on
};

/// The recipe of Dai et al. 2021, section 3.2: a straight line over two horizons, or what the options say.
OpeningFit paper_fit(const PlateScale& scale, const SrifOptions& options);

/// The opening extrapolated to the crack from two rows, a parabola K(r) over half a thickness, at least 8 spacings,
/// from the second sample on: the terms r^(1/2), r^(3/2), r^(5/2) of the opening.
OpeningFit series_fit(const PlateScale& scale);

/// The first samples behind the tip, for the proportions of the three modes.
OpeningFit narrow_fit(const PlateScale& scale);

/// Crack-surface displacement extrapolation (Dai 39-41, section 3.2): the jump of w and the
/// rotations across the crack at distances r behind the tip gives K(r); the straight line through K(r) by least squares
/// gives K at r = 0. The deflection is carried from the rows of points to the crack line by the rotation there,
/// w - y' theta_x': without it a mere inclination of the plate would pass for K3. Built once per tip, evaluated at any
/// number of times.
class DisplacementExtrapolation {
public:
  /// Finds the samples behind a tip; or says why there is no extrapolation: the window holds fewer samples than the fit
  /// needs, or no points lie beside the crack. `positions`: points of the plate. `path`: the tip's crack.
  static std::variant<DisplacementExtrapolation, std::string> at(const std::vector<geometry::Point>& positions,
                                                                 const geometry::CrackPath& path,
                                                                 const geometry::Tip& tip, const PlateScale& scale,
                                                                 const OpeningFit& how);

  /// K1, K2, K3 in the tip's axes (x' ahead, y' 90 degrees to its left) [see Srif].
  Srif operator()(const plate::State& state) const;

private:
  struct Sample {
    double r;                         // distance behind the tip, along the crack [length]
    geometry::Point ahead;            // direction of the crack there
    std::vector<plate::Share> jump;   // upper face minus lower face
    std::vector<plate::Share> lever;  // the same shares times their distance y' from the crack [length]
  };

  DisplacementExtrapolation(const geometry::Tip& tip, const PlateScale& scale, const OpeningFit& how);

  /// Distance by which the points may end their crack ahead of the tip [length]: half way between two columns, from the
  /// `first` sample behind the tip, and at least a quarter of a spacing.
  double unknown_place(double first) const { return std::max(scale_.spacing / 4, scale_.spacing / 2 - first); }

  geometry::Tip tip_;
  PlateScale scale_;
  OpeningFit how_;
  Eigen::Matrix3d stiffness_;  // K by the jumps of -psi and w over the root of the distance (Dai 41)
  std::vector<Sample> samples_;
};

}  // namespace post
