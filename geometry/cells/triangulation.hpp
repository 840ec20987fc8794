#pragma once
#include <array>
#include <string>
#include <variant>

#include "geometry/lattice/curves.hpp"

namespace geometry {

/// Triangles that know their neighbours.
struct Triangulated {
  static constexpr std::int32_t none = -1;
  std::vector<std::array<std::uint32_t, 3>> corners;  // counter-clockwise
  std::vector<std::array<std::int32_t, 3>> across;    // beyond the side opposite to each corner
};

/// Triangulates all points, with the pieces among the sides; or says why it cannot: two points lie at one place, or
/// pieces cross.
std::variant<Triangulated, std::string> delaunay(const std::vector<Point>& points,
                                                 const std::vector<std::array<std::uint32_t, 2>>& pieces);
/// Returns what delaunay() does. Throws std::invalid_argument where it cannot.
Triangulated required_triangles(const std::vector<Point>& points,
                                const std::vector<std::array<std::uint32_t, 2>>& pieces);

/// A side that parts what belongs to the plate from what does not: which of both lies to its left and right.
struct Fence {
  std::uint32_t from, to;
  bool left, right;
};

/// The fences that the pieces of edges are: the plate lies to their left.
std::vector<Fence> fences(const std::vector<Curves::Piece>& pieces);

/// Marks the triangles that belong to the plate: told by the fences, and by what is connected between them, never by
/// coordinates. Throws std::logic_error where fences contradict each other.
std::vector<char> within(const Triangulated& triangles, const std::vector<Fence>& fences);

/// A triangulation to which points are added. Marked sides, those of curves, stay sides, whole or in halves. Triangles
/// beside the plate are kept too, so that one can walk across them. All decisions are by exact predicates.
class TriangleMesh {
public:
  static constexpr std::int32_t none = -1, unmarked = -2;

  struct Triangle {
    std::array<std::uint32_t, 3> corner;  // counter-clockwise
    std::array<std::int32_t, 3> across;   // beyond the side opposite to each corner, or none
    std::array<std::int32_t, 3> mark;     // of that side: Curves::Piece::edge, or unmarked
    bool inside;                          // in the plate
  };
  /// A side of what a new point changes, seen from there; `beyond`: the triangle on its other side.
  struct Rim {
    std::uint32_t from, to;
    std::int32_t beyond, mark;
  };

  /// Throws std::invalid_argument where pieces cross.
  explicit TriangleMesh(const Curves& curves);

  const std::vector<Point>& points() const { return points_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }

  /// The triangle about x, on the way from one to the next from `start` on; where `up_to_marks`, the last one before a
  /// mark in the way and which side of it that is. None outside all triangles.
  struct Found {
    std::int32_t triangle = none;
    std::optional<std::size_t> blocked = {};
  };
  Found locate(const Point& x, std::int32_t start, bool up_to_marks) const;

  /// Finds what would change if x, in a triangle, became a point: rim(), a closed ring about it. False where it may
  /// not.
  bool carve(std::int32_t triangle, const Point& x);
  const std::vector<Rim>& rim() const { return rim_; }
  /// Makes x, for which carve() was true, a point; changed() are the triangles about it.
  void insert(const Point& x);
  /// Makes the middle of a marked side a point. False where it may not.
  bool halve(std::int32_t triangle, std::size_t side);
  const std::vector<std::int32_t>& changed() const { return cavity_; }

  /// The caller sees to it that no triangle turns over.
  void move(std::uint32_t k, const Point& x) { points_[k] = x; }
  /// Sides exchanged until no circle about a triangle holds a point that is seen from there.
  void exchange_sides();

private:
  static std::size_t after(std::size_t i) { return i == 2 ? 0 : i + 1; }
  static std::size_t before(std::size_t i) { return i == 0 ? 2 : i - 1; }
  bool in_circle(std::int32_t triangle, const Point& x) const;
  /// Side of the triangle that runs from a to b.
  std::size_t side_of(std::int32_t triangle, std::uint32_t a, std::uint32_t b) const;
  void begin(std::initializer_list<std::int32_t> triangles);
  void expand(std::int32_t triangle, std::size_t side, const Point& x);
  bool sees_rim(const Point& x) const;
  void fill(const Point& x, std::size_t first_half, std::int32_t mark);
  void exchange(std::int32_t triangle, std::size_t side);

  std::vector<Point> points_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> stamp_;  // per triangle
  std::uint32_t now_ = 0;
  std::vector<std::int32_t> cavity_;
  std::vector<Rim> rim_;
  std::vector<std::pair<std::int32_t, std::size_t>> sides_;  // of triangles, still to be looked at
};

}  // namespace geometry
