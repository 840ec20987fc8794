#pragma once
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "geometry/shape/crack_path.hpp"
#include "geometry/shape/outline.hpp"
#include "plate/model/formula.hpp"

namespace plate {

/// How a load varies in time, as a factor of its value.
struct History {
  enum class Kind { step, ramp, sine, table };
  Kind kind = Kind::step;
  double rise_time = 0;                          // ramp: linear from 0 to 1 over this time, then 1
  double frequency = 0;                          // sine: sin(2 pi f t)
  std::vector<std::pair<double, double>> table;  // table: (time, factor), times ascending; constant beyond its ends

  bool constant() const { return kind == Kind::step; }
  bool operator==(const History&) const = default;
};

/// The factor at time t >= 0; a step is 1 from t = 0 on.
double factor(const History& history, double time);

/// A pressure by its values at places, from a CSV text with the columns x, y and pressure: bilinear between the places
/// of a grid in any order, else linear on the triangles of Delaunay.
class PressureTable {
public:
  PressureTable() = default;
  /// `content`: of the file. Throws std::invalid_argument: what is wrong, with the number of the line.
  PressureTable(const std::string& content, const std::filesystem::path& file);

  bool given() const { return bool(values_); }
  const std::filesystem::path& file() const;
  /// Digest of the file's content, 16 digits.
  const std::string& digest() const;
  bool gridded() const;
  /// Times a factor.
  PressureTable times(double factor) const;

  bool reaches(const geometry::Point& x) const;
  /// [force/length^2]; beyond its places what it has at the next of them.
  double operator()(const geometry::Point& x) const;

private:
  struct Values;
  std::shared_ptr<const Values> values_;
  double factor_ = 1;
};

/// One load. Pressure and shear forces act along +w; a positive moment is tension on the z > 0 face, which a positive
/// temperature makes the warmer one. A settlement moves a support as a rigid body.
struct Load {
  enum class Kind { pressure, edge_moment, edge_shear, point_force, line_load, temperature, settlement };
  Kind kind = Kind::pressure;
  double value = 0;                     // pressure [force/length^2], moment, shear and line load per length, force,
                                        // temperature of the face z > 0 less that of the other, w [length]
  geometry::Point gradient{0, 0};       // of the pressure [force/length^3], which has its value at `from`
  geometry::Point from{0, 0};           // [length]
  Formula formula;                      // the pressure or temperature, instead of the three
  PressureTable table;                  // the pressure, instead [force/length^2]
  std::optional<double> level;          // of a fluid up to this y, of the unit weight `value` [force/length^3]
  std::optional<double> gravity;        // along w: the value is density thickness gravity [length/time^2]
  std::optional<geometry::Hole> patch;  // the pressure acts on this part of the plate alone
  geometry::Polyline along;             // line_load
  geometry::Polyline path;              // of a point force, or of the middle of a patch, that moves along it
  double speed = 0;                     // [length/time]
  double twist = 0;                     // edge_moment: M_ns beside the normal moment, s = normal turned by +90 degrees
  std::array<double, 3> tensor{0, 0, 0};  // edge_moment: Mxx, Myy, Mxy instead of value and twist
  bool has_tensor = false;
  std::vector<std::string> edges;  // edge loads
  geometry::Point position{0, 0};  // point_force
  std::size_t support = 0;         // settlement: the number of the support
  geometry::Point slope{0, 0};     // settlement: of the support's w, which is `value` at `from`
  double rotation = 0;             // settlement: psi_n of every edge about itself, n its outward normal
  History history;

  /// The same pressure everywhere?
  bool uniform() const { return !patch && gradient.isZero(0) && !formula.given() && !table.given() && !level; }
  /// Is the pressure no linear function of the place, but one that has to be evaluated?
  bool evaluated() const { return formula.given() || table.given(); }
  bool moves() const { return !path.empty(); }
  double pressure(const geometry::Point& x) const {
    if (table.given()) return table(x);
    if (level) return x.y() < *level ? value * (*level - x.y()) : 0;
    return formula.given() ? formula(x) : value + gradient.dot(x - from);
  }
};

/// How a motion begins: deflection [length] and velocity along w [length/time] at time 0, with the rotations of a thin
/// plate, psi = grad w. Not given: zero.
struct Initial {
  Formula deflection, velocity;
};

/// A mass that meets the plate at time 0, and presses on it by a spring that does not pull.
struct Impact {
  geometry::Point position{0, 0};  // [length]
  double mass = 0, velocity = 0;   // velocity along w [length/time]
  double stiffness = 0;            // of the contact [force/length]
};

}  // namespace plate
