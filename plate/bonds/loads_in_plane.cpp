#include "plate/bonds/loads_in_plane.hpp"

#include <algorithm>

#include "plate/formulation/interpolation.hpp"
#include "plate/model/load_integration.hpp"
#include "plate/model/space.hpp"

namespace plate {
namespace {

using geometry::Point;

/// Nodal forces of each kind of load that acts in the plane.
struct InPlaneOnPoints {
  const Boundary& boundary;
  const geometry::Outline& outline;
  const std::vector<geometry::CrackPath>& paths;  // [spacings]
  double reach;                                   // of the points that take over a piece of an edge [spacings]
  const std::vector<Support>& supports;
  Forces& forces;

  void operator()(const EdgeTraction& load) const {
    for (const auto& name : load.edges)
      for (const EdgeBorder& border : edge_borders(name, boundary.cloud, outline, reach)) {
        std::vector<Point> places;
        for (const auto k : border.near) places.push_back(boundary.lattice[k]);
        for (const EdgePiece& piece : border.pieces)
          for (const auto& share : behind(piece, places))
            add(share.weight * left(name, load.on(piece.normal), piece.normal), border.near[share.point]);
      }
  }
  void operator()(const BodyForce& load) const {
    for (std::uint32_t k = 0; k < boundary.cloud.plate_points; ++k) add(boundary.cloud.areas[k] * load.vector, k);
  }
  void operator()(const PointForce& load) const {
    for (const auto& share :
         visible_place(load.position, boundary.cloud.units, boundary.lattice, boundary.cloud.plate_points, paths))
      add(share.weight * load.vector, share.point);
  }
  template <class Other>
  void operator()(const Other&) const {}

private:
  /// The part of a force on an edge that no support takes at once.
  Point left(const std::string& edge, const Point& force, const Point& outward) const {
    const Point normal = outward.normalized();
    Point result = force;
    for (const auto& support : supports) {
      if (std::ranges::find(support.edges, edge) == support.edges.end()) continue;
      const Point across = result.dot(normal) * normal;
      if (support.kind == SupportKind::clamped) result = {0, 0};
      if (support.kind == SupportKind::symmetry) result -= across;
      if (support.kind == SupportKind::simply_supported_hard) result = across;
    }
    return result;
  }
  /// The points behind a piece of an edge.
  std::vector<PlaceShare> behind(const EdgePiece& piece, const std::vector<Point>& places) const {
    const auto& units = boundary.cloud.units;
    const Point at = units.to_lattice(piece.middle);
    auto seen = visible_from(at, reach, places, places.size(), paths);
    std::erase_if(seen, [&](const PlacedPoint& one) { return (one.second - at).dot(piece.normal) > 0; });
    if (seen.empty()) return visible_place(piece.middle, units, places, places.size(), paths);
    return place_shares(seen, units.to_units(piece.middle), units.spacing);
  }
  void add(const Point& force, std::uint32_t k) const { forces.col(k) += PointValues(0, -force.y(), force.x()); }
};

}  // namespace

Forces forces_in_plane(const Load& load, const Boundary& boundary, const geometry::Outline& outline,
                       const std::vector<geometry::CrackPath>& paths, double horizon_ratio,
                       const std::vector<Support>& supports) {
  Forces result = zero_forces(boundary.cloud.size());
  const auto in_spacings = geometry::to_lattice(paths, boundary.cloud.units);
  std::visit(InPlaneOnPoints{boundary, outline, in_spacings, horizon_ratio + 1, supports, result}, load.action);
  return result;
}

}  // namespace plate
