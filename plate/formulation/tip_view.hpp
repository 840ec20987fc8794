#pragma once
#include <memory>

#include "geometry/lattice/families.hpp"
#include "geometry/shape/crack_path.hpp"
#include "plate/formulation/bond_law.hpp"
#include "plate/formulation/sections.hpp"
#include "plate/model/section.hpp"
#include "plate/model/state.hpp"

namespace plate {

/// Axes at a crack tip: x' straight ahead, y' 90 degrees to its left. The crack behind the tip is straight, or a curve
/// that follows a circle there.
struct TipFrame {
  geometry::Point origin, ahead;
  double curvature = 0;        // of that circle, positive where it bends to the left [1 / length]
  geometry::Polyline curve{};  // the curve as it is drawn, towards the tip; empty where the crack is straight

  TipFrame(const geometry::Tip& tip) : origin(tip.position), ahead(tip.direction) {}
  geometry::Point left() const { return {-ahead.y(), ahead.x()}; }
  geometry::Point local(const geometry::Point& x) const { return {ahead.dot(x - origin), left().dot(x - origin)}; }
  /// Velocity of a place that goes with the tip as it moves on with unit speed: about the centre of the circle, along
  /// which the crack then slides in itself (theory, "Curved cracks").
  geometry::Point velocity(const geometry::Point& x) const {
    if (curvature == 0) return ahead;
    const geometry::Point from = x - origin;
    return ahead + curvature * geometry::Point(-from.y(), from.x());
  }
  /// Place beside the circle: the way ahead along it, and the distance to its left [length].
  geometry::Point by_circle(const geometry::Point& x) const;
  /// Place beside the crack as it is drawn: the way ahead along it, and the distance to its left [length].
  geometry::Point beside(const geometry::Point& x) const;
};

/// Side of the crack on which geometry::separates puts a point: +1 for y' > 0, -1 for y' < 0. A point on the line
/// itself lies where moving it by (e, e^2) would put it. `y`: its y' [length], zero below 1e-7 spacings.
int face_of(double y, const geometry::Point& left, double spacing);

/// Polar coordinates in the tip's axes; angle in [-pi, pi], +-pi on the faces.
struct Polar {
  double r, angle;
};
Polar polar(const TipFrame& frame, const geometry::Point& x, double spacing);

/// The annulus in which the extension q falls from 1 to 0 [length].
struct Ring {
  double inner, outer;

  double extension(double r) const;  // q
  double slope(double r) const;      // dq/dr
};

/// A state less the rigid motion of the points next to the tip, which does no work but would cost digits.
class NearField {
public:
  /// `centre`: the points whose mean motion is taken away.
  NearField(const State& state, const std::vector<geometry::Point>& positions,
            const std::vector<std::uint32_t>& centre);

  Kinematics<> operator()(std::uint32_t k) const;

private:
  const State& state_;
  const std::vector<geometry::Point>& positions_;
  geometry::Point place_{0, 0};
  Eigen::Vector3d mean_{0, 0, 0};
};

/// -dU/da [force] of the strain energy of a field carried along with a tip that moves straight ahead, of which only the
/// points of a ring take part.
class EnergyRelease {
public:
  virtual ~EnergyRelease() = default;
  virtual double operator()(const NearField& field) const = 0;
};

/// A gradient at a point, of differences along its bonds.
struct GradientShares {
  std::vector<geometry::Bond> bonds;
  Eigen::Matrix2Xd share;  // per bond: of a difference along the bond, in the gradient
};

/// Weights in the error estimates of intensity factors, with the quantity that each multiplies: measured for each
/// formulation (theory.md, "What the estimated errors mean").
struct TipErrorWeights {
  double energy, shear;  // of the difference between energies of the fit and of the integrals, in K1 and K2, and in K3
  double fits, fits_shear;  // of the largest difference between fits: their turn, in K1 and K2, and in K3
  double near;              // of the largest factor, where a spacing lies between a tip and what is next to it
  double layer;             // of the largest factor, in K3, where `width` is as wide as the layer beside the faces
  double width;             // [length]
  double doubt;          // beyond this the difference between those energies counts in full, and as a turn of K1 and K2
  double lost;           // K3 is not resolved where its error is above this share of the largest factor
  bool domain_integral;  // is always the better of the two integrals
  double own_shear = 0;  // of K3 itself; with points on faces times 1 + their distance over the layer
  double stairs = 0;  // of the angle between a crack and the lattice, as a turn of K1 and K2 where a fit sees no step
  double near_sliding = 0;  // added to `near` in K2
};

/// A plate as the tips of its cracks see it: its points, and what of its mechanics depends on the formulation. All that
/// it refers to must outlive it.
class TipView {
public:
  virtual ~TipView() = default;

  const std::vector<geometry::Point>& positions;  // points of the plate first; those on a face of a crack beside it
  const std::vector<double>& areas;
  const geometry::Families& families;
  const std::vector<BondShape>& shapes;  // of the vectors of the families
  std::size_t plate_points;
  Section section;
  double spacing, horizon;       // at the tips [length]
  bool graded, points_on_faces;  // points of varying distance; on the faces of cracks
  double doubtful;  // points nearer to the line of a crack do not tell their side, or are not accurate [length]
  TipErrorWeights trust;

  virtual Gradients gradients(std::uint32_t k, const State& state) const = 0;
  virtual GradientShares gradient_shares(std::uint32_t k) const = 0;
  /// grad q of an extension [1 / length].
  virtual geometry::Point extension_slope(std::uint32_t k, const TipFrame& frame, const Ring& ring) const = 0;
  /// [force / length]
  virtual Eigen::Matrix2d shear_stiffness(std::uint32_t k) const = 0;
  /// Energy release rate by moving what stores the energy of the ring (virtual crack extension; theory (47)).
  virtual std::unique_ptr<EnergyRelease> virtual_extension(const TipFrame& frame, const Ring& ring) const = 0;

protected:
  TipView(const std::vector<geometry::Point>& at, const std::vector<double>& their_areas,
          const geometry::Families& their_families, const std::vector<BondShape>& their_shapes, std::size_t of_plate,
          const Section& its_section)
      : positions(at),
        areas(their_areas),
        families(their_families),
        shapes(their_shapes),
        plate_points(of_plate),
        section(its_section) {}
  TipView(const TipView&) = default;
};

}  // namespace plate
