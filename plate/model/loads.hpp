#pragma once
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "geometry/shape/crack_path.hpp"
#include "geometry/shape/outline.hpp"
#include "plate/model/formula.hpp"
#include "plate/model/history.hpp"

namespace plate {

/// A pressure by its values at places, from a CSV text with the columns x, y and pressure: bilinear between the places
/// of a grid in any order, else linear on the triangles of Delaunay.
class PressureTable {
public:
  PressureTable() = default;
  /// Constructs the table of a content that is known to be one. Throws std::invalid_argument where parsed() has none.
  PressureTable(const std::string& content, const std::filesystem::path& file);
  /// Parses the content of a file. Returns the table, or what is wrong with the number of the line.
  static std::variant<PressureTable, std::string> parsed(const std::string& content, const std::filesystem::path& file);

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

/// Force along +w per area: a value at `from` that grows by a gradient, a formula, a table, a fluid up to a level, or
/// own weight; on the whole plate, a part of it, or a part that moves along a path.
struct Pressure {
  static constexpr const char* name = "pressure";
  double value = 0;                          // [force/length^2]; of a fluid its unit weight [force/length^3]
  geometry::Point gradient{0, 0};            // [force/length^3]
  geometry::Point from{0, 0};                // [length]
  Formula formula = {};                      // [force/length^2], instead of the three
  PressureTable table = {};                  // instead
  std::optional<double> level = {};          // y up to which the fluid stands [length]
  std::optional<double> gravity = {};        // along w: the value is density thickness gravity [length/time^2]
  std::optional<geometry::Hole> patch = {};  // acts here alone
  geometry::Polyline path = {};              // of the middle of the patch
  double speed = 0;                          // [length/time]

  /// True for a pressure with the same value everywhere on the plate.
  bool uniform() const { return !patch && gradient.isZero(0) && !formula.given() && !table.given() && !level; }
  /// True for a pressure that is no linear function of the place, but one that has to be evaluated.
  bool evaluated() const { return formula.given() || table.given(); }
  double at(const geometry::Point& x) const {
    if (table.given()) return table(x);
    if (level) return x.y() < *level ? value * (*level - x.y()) : 0;
    return formula.given() ? formula(x) : value + gradient.dot(x - from);
  }
};

/// Moments on edges; positive is tension on the z > 0 face.
struct EdgeMoment {
  static constexpr const char* name = "edge_moment";
  std::vector<std::string> edges = {};
  double value = 0;                                  // normal moment M_n per length [force]
  double twist = 0;                                  // M_ns, s = normal turned by +90 degrees [force]
  std::optional<std::array<double, 3>> tensor = {};  // Mxx, Myy, Mxy instead of both [force]

  /// (M_nx, M_ny) = M n on an edge with the normal n of any length.
  geometry::Point on(const geometry::Point& n) const;
};

/// Shear force along +w on edges [force/length].
struct EdgeShear {
  static constexpr const char* name = "edge_shear";
  std::vector<std::string> edges = {};
  double value = 0;
};

/// Membrane forces on edges; positive is tension.
struct EdgeTraction {
  static constexpr const char* name = "edge_traction";
  std::vector<std::string> edges = {};
  double value = 0;                                  // N_nn per length [force/length]
  double shear = 0;                                  // N_ns, s = normal turned by +90 degrees [force/length]
  std::optional<std::array<double, 3>> tensor = {};  // Nxx, Nyy, Nxy instead of both [force/length]

  /// (N_nx, N_ny) = N n on an edge with the normal n of any length.
  geometry::Point on(const geometry::Point& n) const;
};

/// Force in the plane per area [force/length^2].
struct BodyForce {
  static constexpr const char* name = "body_force";
  geometry::Point vector{0, 0};
};

/// Force at a point, or along +w at one that moves along a path.
struct PointForce {
  static constexpr const char* name = "point_force";
  geometry::Point position{0, 0};  // [length]
  double value = 0;                // along +w [force]
  geometry::Polyline path = {};
  double speed = 0;              // [length/time]
  geometry::Point vector{0, 0};  // in the plane [force]
};

/// Force along +w per length of a line [force/length].
struct LineLoad {
  static constexpr const char* name = "line_load";
  geometry::Polyline along = {};
  double value = 0;
};

/// Temperature, linear over the thickness. Each part is a value or a formula.
struct Temperature {
  static constexpr const char* name = "temperature";
  double value = 0;  // of the face z > 0 less that of the other; in the plane the mean
  Formula formula = {};
  double mean = 0;  // of the middle plane above that without stress
  Formula mean_formula = {};
};

/// Motion of a support as a rigid body, and of every edge about itself.
struct Settlement {
  static constexpr const char* name = "settlement";
  std::size_t support = 0;                  // its number
  double value = 0;                         // w at `from` [length]
  geometry::Point slope{0, 0}, from{0, 0};  // of the support's w
  double rotation = 0;                      // psi_n of every edge, n its outward normal
};

/// Load: what acts, and how it varies in time.
struct Load {
  using Action = std::variant<Pressure, EdgeMoment, EdgeShear, EdgeTraction, BodyForce, PointForce, LineLoad,
                              Temperature, Settlement>;
  Action action;
  History history = {};

  template <class T>
  const T* as() const {
    return std::get_if<T>(&action);
  }
  template <class T>
  T* as() {
    return std::get_if<T>(&action);
  }

  /// Name of what acts.
  std::string name() const;
  /// One action of each kind, with nothing given.
  static std::vector<Action> kinds();

  // Members that loads of several kinds have; empty, or nothing, where this one does not.
  const std::vector<std::string>& edges() const;
  const geometry::Polyline& line() const;
  const geometry::Polyline& path() const;
  double speed() const;
  const Formula& formula() const;
  /// Point where a force acts that does not move.
  std::optional<geometry::Point> point() const;

  bool moves() const { return !path().empty(); }
  /// True of a load that acts in the plane, alone or beside what acts across it.
  bool in_plane() const;
};

/// Makes a load some times as large.
void scale(Load& load, double factor);

/// Initial conditions of a motion: deflection [length] and velocity along w [length/time] at time 0, with the rotations
/// of a thin plate, psi = grad w. Not given: zero.
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
