#pragma once
#include <functional>

#include "geometry/shape/outline.hpp"

namespace plate {

/// Of a function f over a part of the plate: the integrals of f, of f (x - about) and of |f|, and what the first may be
/// wrong by where halving triangles did not help.
struct Integral {
  double value = 0;
  geometry::Point first{0, 0};
  double size = 0, error = 0;

  Integral& operator+=(const Integral& other);
};

/// Integrates over polygons, each as if it stood alone. Triangles are parted into four until that changes an integral
/// by less than 1e-4 of what the largest |f| of the polygon so far would give there, at most five times more than once:
/// a jump of f is placed within a hundredth of a triangle, and what is narrower than a tenth of it may be missed.
class Cubature {
public:
  using Function = std::function<double(const geometry::Point&)>;
  explicit Cubature(Function f) : f_(std::move(f)) {}

  /// `ring`: a polygon that is seen as a whole from its middle.
  Integral operator()(const std::vector<geometry::Point>& ring, const geometry::Point& about);

private:
  struct Triangle;
  Integral rule(const Triangle& triangle, const geometry::Point& about);
  Integral refined(const Triangle& triangle, const Integral& coarse, const geometry::Point& about, int depth);

  Function f_;
  double largest_ = 0;  // |f|, of the polygon in hand
};

}  // namespace plate
