#pragma once
#include "geometry/cloud.hpp"
#include "plate/section.hpp"
#include "plate/state.hpp"
#include "post/interpolation.hpp"
#include <optional>

/// What leaves the program: intensity factors, tables, files for ParaView and HDF5.
namespace post {

/// The forces or moments that F = K / (...) refers to: pressure and width: F = K / (p (W/2)^2 sqrt a);
/// moment: F = K / (M sqrt a). F3 has K3 times the thickness, to be without dimension.
struct Normalization {
  std::optional<double> pressure, width, moment;
};

struct SrifOptions {
  std::vector<std::string> methods{"displacement_extrapolation"};
  double window_horizons = 2;           // fit over 0 < r <= this many horizons (Dai, section 3.2: 2) ...
  std::optional<double> window;         // ... or over this length
  int skip = 0;                         // samples next to the tip left out
  int rows = 1;                         // rows of points on each side: 1 nearest row, 2 extrapolated to the crack
  std::optional<Normalization> normalize;
  std::optional<double> half_length;    // the a of the normalisation
};

/// Moment and shear intensity factors of one tip by one method (no pi: K1 = lim sqrt(2 r) M_nn).
struct Srif {
  std::size_t tip = 0;
  geometry::Point position{0, 0};
  std::string method;
  double K1 = 0, K2 = 0, K3 = 0;                // [force length^(1/2)] moments, [force / length^(1/2)] shear
  std::optional<double> F1, F2, F3;             // where a normalisation is given
  std::optional<double> estimated_error;        // relative to the largest K
  double fit_residual = 0;                      // rms misfit of the straight line / largest |K| of the fit
  std::size_t samples = 0;
};

/// The numbers that displacement extrapolation needs of a plate.
struct PlateScale {
  plate::Section section;
  double spacing, horizon;  // [length]
};

/// Crack-surface displacement extrapolation (Dai et al. 2021, section 3.2, Eqs. 39-41): the jump of w and the
/// rotations across the crack at distances r behind the tip gives K(r); the straight line through K(r) by least squares
/// gives K at r = 0. The deflection is carried from the rows of points to the crack line by the rotation there,
/// w - y' theta_x': without it a mere inclination of the plate would pass for K3. Built once per tip, evaluated at any number of times.
class DisplacementExtrapolation {
public:
  /// `positions`: points of the plate. `path`: the tip's crack. Throws std::invalid_argument where the window holds
  /// fewer than two samples, or no points lie beside the crack.
  DisplacementExtrapolation(const std::vector<geometry::Point>& positions, const geometry::CrackPath& path,
                            const geometry::Tip& tip, const PlateScale& scale, const SrifOptions& options);

  /// K1, K2, K3 in the tip's axes (x' ahead, y' 90 degrees to its left) [see Srif].
  Srif operator()(const plate::State& state) const;

private:
  struct Sample {
    double r;                            // distance behind the tip [length]
    std::vector<Share> jump;             // upper face minus lower face
    std::vector<Share> lever;            // the same shares times their distance y' from the crack [length]
  };

  geometry::Tip tip_;
  PlateScale scale_;
  std::vector<Sample> samples_;
};

/// F1, F2, F3 where the options give a normalisation.
void normalize(Srif& srif, const SrifOptions& options, double thickness);

}  // namespace post
