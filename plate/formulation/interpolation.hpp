#pragma once
#include <cstdint>
#include <utility>
#include <vector>
#include "geometry/shape/crack_path.hpp"
#include "plate/model/state.hpp"

namespace geometry {
class CellLocator;
struct LatticeUnits;
}  // namespace geometry

namespace plate {

/// A point's weight in an interpolated value.
struct Share {
  std::uint32_t point;
  double weight;
};

/// A point's part in the state at a place: every component takes weight times that of the point, and the deflection
/// lever . psi beside it, with psi = (-theta_y, theta_x).
struct PlaceShare {
  std::uint32_t point;
  double weight;
  geometry::Point lever{0, 0};  // [length]
};

/// Transfer of displacements from the points of a coarser plate to those of a finer one, or back: the shares that every
/// point takes of others. The deflection takes what rotations add to it in a plate without shear.
template <typename Real>
struct LevelTransfer {
  struct Share {
    std::uint32_t other;
    Real weight, x, y;  // x, y: weight times lever of theta_y (negative) and theta_x [length]
  };
  std::vector<std::size_t> first;  // where the shares of a point begin [points + 1]
  std::vector<Share> shares;

  /// `others`: number of the points that shares are taken of.
  LevelTransfer transposed(std::size_t others) const {
    LevelTransfer result;
    result.first.assign(others + 1, 0);
    for (const auto& share : shares) ++result.first[share.other + 1];
    for (std::size_t i = 0; i < others; ++i) result.first[i + 1] += result.first[i];
    result.shares.resize(shares.size());
    auto next = result.first;
    for (std::uint32_t k = 0; k + 1 < first.size(); ++k)
      for (auto i = first[k]; i < first[k + 1]; ++i) {
        const Share& share = shares[i];
        result.shares[next[share.other]++] = {k, share.weight, share.x, share.y};
      }
    return result;
  }
};

/// Degrees of freedom (plate/model/space.hpp) and their factors.
using DofTerms = std::vector<std::pair<Dof, double>>;

/// w, theta_x and theta_y at a place.
PointValues value_at(const std::vector<PlaceShare>& place, const State& state);
/// Terms of one component as a sum over degrees of freedom.
DofTerms terms_of(const std::vector<PlaceShare>& place, std::uint32_t component);

using PlacedPoint = std::pair<std::uint32_t, geometry::Point>;

/// Points among the first `count` that lie within `reach` of the place and that no crack separates from it. Lengths in
/// spacings.
std::vector<PlacedPoint> visible_from(const geometry::Point& at, double reach,
                                      const std::vector<geometry::Point>& points, std::size_t count,
                                      const std::vector<geometry::CrackPath>& cracks);

/// Linear moving least squares with weight 1/distance^2 over the points given: exact for linear fields where the
/// points span the plane, the point's own value where `at` is one of them, empty without points. Points on one line
/// give the weights of least norm, which do not add up to 1: place_shares() does. Lengths in spacings.
std::vector<Share> interpolation(const std::vector<PlacedPoint>& points, const geometry::Point& at);

/// Distance of points between which all places of a plate lie but those in acute corners [spacings].
constexpr double reach_of_places = 1.6;

/// The state at a place that moves with the points as a rigid body where they do: interpolation(); where that has
/// weights above 3, or the points do not span the plane, the mean of the tangent planes of the points with weight
/// 1/distance^2. Positions in spacings, the levers in lengths. Throws std::invalid_argument without points.
std::vector<PlaceShare> place_shares(const std::vector<PlacedPoint>& points, const geometry::Point& at, double spacing);

/// The state at a place [length] by the first `count` points that it sees within 1.6 spacings, else within 3.2;
/// `cracks` in spacings. Throws Refused where it sees none.
std::vector<PlaceShare> visible_place(const geometry::Point& at, const geometry::LatticeUnits& units,
                                      const std::vector<geometry::Point>& points, std::size_t count,
                                      const std::vector<geometry::CrackPath>& cracks);

/// Linear in a triangle, bilinear in a square: in the cell about `at` [length], or nearest to it. A place on a crack
/// belongs to the cell on the side of +x, or of +y where the crack is horizontal.
std::vector<PlaceShare> interpolation(const geometry::CellLocator& cells, double spacing, const geometry::Point& at);

}  // namespace plate
