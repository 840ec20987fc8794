#pragma once
#include "geometry/crack_path.hpp"
#include "plate/section.hpp"
#include <array>
#include <complex>
#include <map>

namespace post {

/// Axes at a crack tip: x' straight ahead, y' 90 degrees to its left.
struct TipFrame {
  geometry::Point origin, ahead;

  explicit TipFrame(const geometry::Tip& tip) : origin(tip.position), ahead(tip.direction) {}
  geometry::Point left() const { return {-ahead.y(), ahead.x()}; }
  geometry::Point local(const geometry::Point& x) const { return {ahead.dot(x - origin), left().dot(x - origin)}; }
};

/// Side of the crack on which geometry::severs puts a point: +1 for y' > 0, -1 for y' < 0. A point on the line itself lies
/// where moving it by (e, e^2) would put it. `y`: its y' [length], zero below 1e-7 spacings.
int face_of(double y, const geometry::Point& left, double spacing);

/// Polar coordinates in the tip's axes; angle in [-pi, pi], +-pi on the faces.
struct Polar {
  double r, angle;
};
Polar polar(const TipFrame& frame, const geometry::Point& x, double spacing);

/// A field f(r, angle) = Re sum c r^p exp(i q angle), with p and q in halves; keys are 2p, 2q.
class PowerSum {
public:
  static PowerSum term(int twice_p, int twice_q, std::complex<double> c);

  PowerSum& operator+=(const PowerSum& other);
  PowerSum operator*(double factor) const;
  PowerSum dx() const;
  PowerSum dy() const;
  double operator()(const Polar& at) const;
  /// The factor of r^p at an angle.
  double coefficient(int twice_p, double angle) const;
  const auto& terms() const { return terms_; }

private:
  std::map<std::pair<int, int>, std::complex<double>> terms_;
};

/// One of the fields K1 = 1, K2 = 1, K3 = 1 of a straight crack in an unloaded Mindlin plate, in the tip's axes: an exact
/// solution, w biharmonic, psi = grad(w + D/S lap w) + rot(chi), chi of modified Bessel functions, with free faces to the
/// order of the series (theory.md, "Unit fields"). Its singular part is Eq. 39 of Dai et al. (Sosa and Eischen 1986).
class TipField {
public:
  TipField(const plate::Section& section, int mode);  // mode 0, 1, 2: K1, K2, K3

  /// w, psi_x', psi_y'.
  Eigen::Vector3d operator()(const Polar& at) const;
  /// Its derivative along x'.
  Eigen::Vector3d along_crack(const Polar& at) const;
  /// Moments M_x'x', M_y'y', M_x'y' and shear forces, as in Resultants.
  Eigen::Vector3d moments(const Polar& at) const;
  Eigen::Vector2d shear(const Polar& at) const;

  /// The series is good within this many thicknesses of the tip: faces free to 1e-4 of the singular stress.
  static constexpr double reach = 1.5;

private:
  plate::Section section_;
  PowerSum w_, psi_x_, psi_y_;                    // lengths in thicknesses
  PowerSum w_slope_, psi_x_slope_, psi_y_slope_;  // d/dx' of them
};

}  // namespace post
