#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/outline.hpp"

namespace plate {
struct Section;
}  // namespace plate

/// Output of the program: intensity factors, tables, files for ParaView and HDF5.
namespace post {

/// The forces or moments that F = K / (...) refers to: pressure and width: F = K / (p (W/2)^2 sqrt a);
/// moment: F = K / (M sqrt a). F3 has K3 times the thickness, to be without dimension.
struct Normalization {
  std::optional<double> pressure, width, moment;
};

/// Methods of finding intensity factors. `opening`: proportions of the modes alone, from the first samples behind a
/// tip; `refinement`: the limit of several discretisations (refined()).
enum class SrifMethod {
  virtual_crack_extension,
  domain_integral,
  series_fit,
  displacement_extrapolation,
  opening_series,
  opening,
  refinement
};
/// Name of a method in files, keys and messages.
const char* name_of(SrifMethod method);
/// Method of a name; none of any other text.
std::optional<SrifMethod> srif_method(const std::string& name);

struct SrifOptions {
  std::vector<SrifMethod> methods{SrifMethod::virtual_crack_extension, SrifMethod::domain_integral,
                                  SrifMethod::series_fit, SrifMethod::displacement_extrapolation};
  double window_horizons = 2;       // displacement extrapolation: fit over 0 < r <= this many horizons (Dai: 2) ...
  std::optional<double> window;     // ... or over this length
  int skip = 0;                     // samples next to the tip left out
  int rows = 1;                     // rows of points on each side: 1 nearest row, 2 extrapolated to the crack
  bool richardson = false;          // estimate the error from a second run with twice the spacing
  bool first_ring_only = false;     // of every integral; then no errors are estimated from rings
  bool second_formulation = false;  // ... and from a run in the other formulation of the plate
  std::optional<double> accuracy;   // find the discretisation that gives every factor to this share of the largest
  double accuracy_seconds = 600;    // ... as far as it is expected to be found in this time
  std::optional<double> toughness;  // K_Ic: what utilisations refer to
  std::optional<Normalization> normalize;
  std::optional<double> half_length;  // the a of the normalisation
};

/// The intensity factors from one ring about the tip.
struct RingSrif {
  double inner, outer;  // [length]
  double G;             // energy release rate of the plate [force]
  double K1, K2, K3;
};

/// The intensity factors from one range of the fit about the tip.
struct FitSrif {
  double inner, outer;  // [length]
  double K1, K2, K3;
};

/// Factors in the plane by the other formulation.
struct SecondInPlane {
  std::array<double, 2> N;
  double difference = 0;  // largest of both, relative to the largest N
};

/// The factors of the same tip by the recommended method of the other formulation.
struct SecondSrif {
  std::string formulation;
  SrifMethod method{};
  double K1 = 0, K2 = 0, K3 = 0;
  double difference = 0;                  // largest of the three, relative to the largest K
  std::optional<SecondInPlane> in_plane;  // where loads act there
};

/// Intensity factors of a tip in the plane: N1 = lim sqrt(2 r) N_nn, N2 of N_ns, with estimated errors
/// [force / length^(1/2)].
struct MembraneFactors {
  std::array<double, 2> N;
  std::array<std::optional<double>, 2> errors;
  std::array<bool, 2> resolved;
  std::optional<double> G;  // energy release rate in the plane [force]
  double thickness = 1;     // of the plate at the tip [length]
};

/// Moment and shear intensity factors of one tip by one method (no pi: K1 = lim sqrt(2 r) M_nn).
struct Srif {
  std::size_t tip = 0;
  geometry::Point position{0, 0};
  SrifMethod method{};
  double K1 = 0, K2 = 0, K3 = 0;                // [force length^(1/2)] moments, [force / length^(1/2)] shear
  std::optional<double> F1, F2, F3;             // where a normalisation is given
  std::optional<double> estimated_error;        // relative to the largest of |K1|, |K2|, |K3| h
  std::array<std::optional<double>, 3> errors;  // estimated, of K1, K2, K3, in their units
  std::optional<double> accuracy_reached;       // where it was asked for: the largest estimated error of this tip
  double lost_shear = 0.1;                      // an error of K3 above this share of the largest leaves nothing of it
  std::array<bool, 3> resolved{true, true, true};  // false: this discretisation does not give that factor
  std::optional<MembraneFactors> membrane;         // where loads act in the plane
  std::optional<SecondSrif> second;                // of a case that is run in both formulations
  std::optional<double> G;                         // energy release rate [force], of methods that find it
  std::vector<RingSrif> rings;                     // of methods that use rings; the first gave the result
  std::vector<FitSrif> fits;                       // of the fit of the fields about the tip; the first gave the result
  double fit_residual = 0;                         // rms misfit of the straight line / largest |K| of the fit
  std::size_t samples = 0;
};

/// An error above this share of the largest factor leaves nothing of a factor that is not the largest.
inline constexpr double lost = 0.1;

/// True where a method reads the opening of the crack, false where it reads the field about the tip.
bool of_opening(SrifMethod method);

/// Factors with those that are not resolved as they were found.
Srif as_resolved(Srif srif);

/// The largest of |K1|, |K2|, |K3| h.
double largest_factor(const Srif& srif, double thickness);

/// The largest factor, N1 and N2 among them as the moments N h / 6, which have the same stress at a face.
double largest_with_plane(const Srif& srif, double thickness);

/// Counts a factor of bending or of the plane as resolved where its error is small beside the factors of the other.
void resolve_together(Srif& srif, double thickness);

/// Recommended factors of each tip: the first that it has.
std::vector<const Srif*> recommended(const std::vector<Srif>& srifs);

/// The difference from the same factors with twice the spacing, those in the plane too, as a bound of the error of the
/// first order.
void widen(Srif& srif, const Srif& coarser, double thickness);

/// Adds to the errors, those of K1, K2 and K3 times the thickness.
void widen(Srif& srif, double error, double thickness);

/// States the difference from the factors of another formulation, those in the plane too; the estimated errors are at
/// least that. `closed`: faces of cracks touch, and the smaller estimate of both formulations is added to it.
void compare_with(Srif& srif, const Srif& other, const std::string& formulation, double thickness, bool closed = false);

/// Face of the plate at which the faces of a crack pass through each other behind a tip, as nothing keeps them from it
/// (theory (76)): K1 > 0 opens the half z > 0 and closes the other. Unknown where K1 is not resolved, or nothing within
/// its estimated error.
enum class Overlap { unknown, below, above, both };  // at z < 0, at z > 0
Overlap overlap(const Srif& srif);
/// "z<0", "z>0" or "", as files have it.
const char* name_of(Overlap overlap);

/// Adds the factors of a plate in its plane, which its methods find as K1 and K2: of the same tip by the same method,
/// the recommended one where a tip has it first.
void add_membrane(std::vector<Srif>& bending, const std::vector<Srif>& membrane, const plate::Section& section);

/// Faces of the plate at which the faces of a crack touch next to its tip.
struct ClosedTip {
  bool top = false, bottom = false;  // at z = h/2, z = -h/2
  double scale = 0;   // the largest force along the crack times the root of the length of all cracks, as N1
  bool layer = true;  // points resolve the layer beside the faces, in which the pressure moves energy into the plane
};

/// Corrects the factors of tips at which faces of a crack touch. Where they touch at one face of the plate, K_I is zero
/// there, N1 = 6 |K1| / h: K1 and N1 share the energy that they release together, which contact only carries from one
/// to the other, and their errors are no less than the change. Where the points do not resolve the layer of that, the
/// virtual crack extension alone finds both energies, and shares of the change are errors. Where they touch at both,
/// K1 = N1 = 0. Factors of bending, and N2 of such tips, that are rounding beside the forces, with their errors, become
/// zero. Of sections of one material.
void close(std::vector<Srif>& srifs, const std::vector<ClosedTip>& tips, const plate::Section& section);

/// F1, F2, F3 where the options give a normalisation.
void normalize(Srif& srif, const SrifOptions& options, double thickness);

/// Stress intensity factors lim sqrt(2 pi r) times stress of one tip, those that are resolved [force length^(-3/2)]:
/// K_I and K_II at the face z > 0, of bending with the other sign at z < 0, and K_III in the middle plane (theory
/// (69)). Of sections of plies none; of a section with directions without equivalent, utilisation and overlap.
struct FaceFactors {
  std::array<std::optional<double>, 3> K;
  std::optional<std::array<std::optional<double>, 2>> below = {};  // K_I, K_II at z < 0, where loads act in the plane
  /// Equivalent mode 1 factor: it takes the same energy at the height where that is largest, a face or the middle plane
  /// (theory (70)).
  std::optional<double> equivalent;
  std::optional<double> height = {};                     // z of `equivalent` over the thickness, -1/2 to 1/2
  std::optional<double> error;                           // estimated, of `equivalent`
  std::optional<double> utilisation, utilisation_error;  // over the toughness, where that is given
  /// Length by which the faces overlap at the closed face of the plate, one thickness behind the tip (theory (76))
  /// [length].
  std::optional<double> overlap = {};
};

FaceFactors at_faces(const Srif& srif, const plate::Section& section, std::optional<double> toughness);

}  // namespace post
