#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>
#include "geometry/shape/crack_path.hpp"
#include "geometry/shape/outline.hpp"
#include "plate/model/history.hpp"
#include "plate/model/loading/formula.hpp"

namespace plate {

/// One load. Pressure and shear forces act along +w; a positive moment is tension on the z > 0 face, which a positive
/// temperature makes the warmer one.
struct Load {
  enum class Kind { pressure, edge_moment, edge_shear, point_force, line_load, temperature };
  Kind kind = Kind::pressure;
  double value = 0;                     // pressure [force/length^2], moment, shear and line load per length, force,
                                        // temperature of the face z > 0 less that of the other
  geometry::Point gradient{0, 0};       // of the pressure [force/length^3], which has its value at `from`
  geometry::Point from{0, 0};           // [length]
  Formula formula;                      // the pressure or temperature, instead of the three
  std::optional<double> gravity;        // along w: the value is density thickness gravity [length/time^2]
  std::optional<geometry::Hole> patch;  // the pressure acts on this part of the plate alone
  geometry::Polyline along;             // line_load
  double twist = 0;                     // edge_moment: M_ns beside the normal moment, s = normal turned by +90 degrees
  std::array<double, 3> tensor{0, 0, 0};  // edge_moment: Mxx, Myy, Mxy instead of value and twist
  bool has_tensor = false;
  std::vector<std::string> edges;  // edge loads
  geometry::Point position{0, 0};  // point_force
  History history;

  /// The same pressure everywhere?
  bool uniform() const { return !patch && gradient.isZero(0) && !formula.given(); }
  double pressure(const geometry::Point& x) const {
    return formula.given() ? formula(x) : value + gradient.dot(x - from);
  }
};

}  // namespace plate
