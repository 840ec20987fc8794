#pragma once
#include <array>
#include <string>
#include <vector>
#include "geometry/shape/outline.hpp"
#include "plate/model/history.hpp"

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

}  // namespace plate
