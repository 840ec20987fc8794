#include "plate/bonds/loads_in_plane.hpp"

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
  Forces& forces;

  void operator()(const EdgeTraction& load) const {
    for (const auto& name : load.edges)
      for (const EdgeBorder& border : edge_borders(name, boundary.cloud, outline)) {
        std::vector<Point> places;
        for (const auto k : border.near) places.push_back(boundary.lattice[k]);
        for (const EdgePiece& piece : border.pieces)
          for (const auto& share : seen_from(piece.middle, places, places.size()))
            add(share.weight * load.on(piece.normal), border.near[share.point]);
      }
  }
  void operator()(const BodyForce& load) const {
    for (std::uint32_t k = 0; k < boundary.cloud.plate_points; ++k) add(boundary.cloud.areas[k] * load.vector, k);
  }
  void operator()(const PointForce& load) const {
    for (const auto& share : seen_from(load.position, boundary.lattice, boundary.cloud.plate_points))
      add(share.weight * load.vector, share.point);
  }
  template <class Other>
  void operator()(const Other&) const {}

private:
  std::vector<PlaceShare> seen_from(const Point& at, const std::vector<Point>& places, std::size_t count) const {
    return visible_place(at, boundary.cloud.units, places, count, paths);
  }
  void add(const Point& force, std::uint32_t k) const { forces.col(k) += PointValues(0, -force.y(), force.x()); }
};

}  // namespace

Forces forces_in_plane(const Load& load, const Boundary& boundary, const geometry::Outline& outline,
                       const std::vector<geometry::CrackPath>& paths) {
  Forces result = zero_forces(boundary.cloud.size());
  const auto in_spacings = geometry::to_lattice(paths, boundary.cloud.units);
  std::visit(InPlaneOnPoints{boundary, outline, in_spacings, result}, load.action);
  return result;
}

}  // namespace plate
