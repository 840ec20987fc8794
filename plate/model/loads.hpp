#pragma once
#include <Eigen/Core>
#include <array>
#include "geometry/lattice/cloud.hpp"
#include "plate/model/history.hpp"
#include "plate/model/state.hpp"

namespace geometry {
struct Tessellation;
}

namespace plate {

/// One load. Pressure and shear forces act along +w; a positive moment is tension on the z > 0 face.
struct Load {
  enum class Kind { pressure, edge_moment, edge_shear, point_force };
  Kind kind = Kind::pressure;
  double value = 0;  // pressure [force/length^2], moment and shear per length, force
  double twist = 0;  // edge_moment: M_ns beside the normal moment, s = normal turned by +90 degrees
  std::array<double, 3> tensor{0, 0, 0};  // edge_moment: Mxx, Myy, Mxy instead of value and twist
  bool has_tensor = false;
  std::vector<std::string> edges;  // edge loads
  geometry::Point position{0, 0};  // point_force
  History history;
};

/// A load case: generalised nodal forces times a factor of time.
struct TimedLoad {
  Forces forces;
  History history;
};

/// Generalised nodal forces (3 x points: work-conjugate to w, theta_x, theta_y) of one load at factor 1.
/// Edge loads act on the edge line: what a point takes over is moved to it with the couple of its lever.
/// `outline` is in the cloud's own units. Throws std::invalid_argument for an edge without points beside it.
Forces nodal_forces(const Load& load, const geometry::Cloud& cloud, const geometry::Outline& outline);

/// The same on points that lie on the edges: half of every piece of an edge at either end, with the couples that make a
/// shear force do the right work on deflections of the third order. `areas` of the points [length^2].
Forces nodal_forces(const Load& load, const geometry::Tessellation& cells, const std::vector<double>& areas);

}  // namespace plate
