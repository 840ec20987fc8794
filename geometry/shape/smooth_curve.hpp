#pragma once
#include <functional>
#include <optional>

#include "geometry/shape/crack_path.hpp"

/// Cracks that are curves. A curve is given by points on it; it is the smooth line through these, which has the circle
/// through every three neighbours as its tangent circle. It is kept as a fine polyline, with bends of about 0.2
/// degrees, and drawn by pieces that touch it, twice as long as the points of a plate are apart.
namespace geometry {

/// A crack that was read as a curve.
struct SmoothCrack {
  Polyline vertices;        // the fine polyline; corners stay
  double largest_bend = 0;  // between the pieces that were given [rad]
  std::size_t pieces = 0;   // that were given of curves
};

/// The smooth curve through points, three at least, as a fine polyline. Corners are smoothed too.
Polyline curve_through(const Polyline& points);

/// An arc as a fine polyline, from one angle to another [rad]; clockwise where the second is the smaller one.
Polyline arc(const Point& centre, double radius, double from, double to);

/// A curve by points with an error.
struct FittedCurve {
  Polyline points;    // on the curve
  double off;         // the largest distance of a given point from it [length]
  std::size_t spans;  // cubic ones; as many as points where none is smooth
};

/// The curve of the fewest cubic spans (B-spline, least squares) that passes all points within `tolerance` [length],
/// has their ends, and leaves no more of them than errors: points as they are read from a picture, six at least.
FittedCurve fitted_curve(const Polyline& points, double tolerance);

/// The smooth curve through the vertices of a crack, wherever at least five bends of at most ten degrees follow each
/// other, as a fine polyline. Points at which other cracks end on it stay on it. Nothing where no part of it is such a
/// curve, or where it is a fine polyline already.
std::optional<SmoothCrack> smooth_crack(const std::vector<Polyline>& cracks, std::size_t which, double tolerance);

/// A crack whose curves, kept as fine polylines, are drawn anew by pieces that touch them in their middle, the first
/// and the last one, half as long, at its ends: tips have the direction of the curve. `size`: half of the length of a
/// piece at a place [length]. Ends of other cracks on it stay vertices. Other parts stay as they are.
Polyline drawn(const std::vector<Polyline>& cracks, std::size_t which, double tolerance,
               const std::function<double(const Point&)>& size);

/// The circle that a curve follows behind its tip.
struct TipCircle {
  Point direction;   // straight ahead
  double curvature;  // positive where the crack behind the tip bends to the left of `direction` [1 / length]
};

/// The circle that touches the last piece of a crack at the tip, and the one before in its middle, as drawn() has them;
/// these are shorter than five spacings and bend by at most fifteen degrees. Nothing where the end is straight or has a
/// kink.
std::optional<TipCircle> tip_circle(const CrackPath& path, bool at_back, double spacing);

/// Distance of a place from a polyline, positive on its left.
double signed_distance(const Polyline& line, const Point& x);

}  // namespace geometry
