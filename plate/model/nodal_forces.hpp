#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "geometry/shape/crack_path.hpp"
#include "geometry/shape/outline.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/point_map.hpp"
#include "plate/model/state.hpp"

namespace geometry {
struct Cloud;
struct Tessellation;
}  // namespace geometry

namespace plate {

struct Problem;
struct Section;

/// Nodal forces of a load that moves along a path: at a few points each time, linear in time between stations. Where
/// the plate is distributed, those on the points that one sees.
struct MovingForces {
  struct Station {
    double time;
    std::vector<std::pair<Dof, double>> forces;  // ascending
  };
  std::vector<Station> stations;  // by time; nothing acts before the first and after the last
  std::vector<char> own = {};     // owned points; empty: all

  /// visit(dof, force) at a time.
  template <typename Visit>
  void at(double time, const Visit& visit) const {
    const auto next = after(time);
    if (next == 0 || next == stations.size()) return;
    const auto &one = stations[next - 1], &other = stations[next];
    const double share = (time - one.time) / (other.time - one.time);
    for (const auto& [dof, force] : one.forces) visit(dof, (1 - share) * force);
    for (const auto& [dof, force] : other.forces) visit(dof, share * force);
  }
  Forces whole(double time, std::size_t points) const;

private:
  std::size_t after(double time) const;  // number of the first station later than that
};

/// Nodal forces of a load with a path and a speed, from time 0 on. `outline` [length]: a force acts within it only;
/// null: everywhere.
MovingForces moving_forces(const Load& load, const geometry::Cloud& cloud, const PointMap& map = {},
                           const geometry::Outline* outline = nullptr);
MovingForces moving_forces(const Load& load, const geometry::Tessellation& cells, std::size_t points,
                           const PointMap& map = {}, const geometry::Outline* outline = nullptr);

/// A load case: generalised nodal forces times a factor of time; of a settlement none, but where it puts what is held
/// while all that is free rests (Constraints::lift).
struct TimedLoad {
  Forces forces;
  History history;
  /// kappa_0 of a temperature at every point of the plate [1 / length], of a membrane alpha T; of other loads empty.
  Eigen::VectorXd curvature = {};
  State lift = no_state();
  std::shared_ptr<const MovingForces> moving = {};  // of a load that moves along a path; `forces` are zero

  bool lifts() const { return lift.cols() > 0; }
};

/// Generalised nodal forces (3 x points: work-conjugate to w, theta_x, theta_y) of one load at factor 1. A temperature,
/// whose forces are of the formulation, gives none, nor do loads that move (moving_forces()). Edge loads act on the
/// edge line: what a point takes over is moved to it with the couple of its lever. `outline` is in the cloud's own
/// units; `own`: owned points, empty: all; `cracks`: a line load stays on its side of them. Throws
/// std::invalid_argument for an edge without points beside it.
Forces nodal_forces(const Load& load, const geometry::Cloud& cloud, const geometry::Outline& outline,
                    const PointMap& map = {}, const std::vector<geometry::CrackPath>& cracks = {});

/// Nodal forces on points that lie on the edges: half of every piece of an edge at either end, with the couples that
/// make a shear force do the right work on deflections of the third order. `areas` of the points [length^2].
Forces nodal_forces(const Load& load, const geometry::Tessellation& cells, const std::vector<double>& areas,
                    const PointMap& map = {});
/// Nodal forces in the plane of what a load does there, conjugate to theta_x = -v and theta_y = u (PlateLaw::membrane).
Forces nodal_forces_in_plane(const Load& load, const geometry::Tessellation& cells, const std::vector<double>& areas);

/// Motion of a support under the settlement that a load is.
struct SupportMotion {
  std::size_t load;  // its number
  Settlement settlement;

  /// w, theta_x, theta_y of the body at a place.
  PointValues at(const geometry::Point& x) const;
  /// w, theta_x, theta_y of what moves with an edge: `beyond` the edge [length], where `outward` is its normal.
  PointValues at(const geometry::Point& x, const geometry::Point& outward, double beyond) const;
};

/// Support motions of all loads of the kind settlement, at factor 1.
std::vector<SupportMotion> support_motions(const Problem& problem);

/// kappa_0 = alpha (temperature at z = h/2 less that at z = -h/2) / h: the curvature in all directions that the plate
/// would take if nothing hindered it, psi = -kappa_0 (x, y), theory (78) [1 / length], at the first `count` positions;
/// of a membrane the strain alpha times the mean temperature, (u, v) = alpha T (x, y). Of plies with strains of their
/// own alpha is 1. Empty of other loads. Throws FormulaError.
Eigen::VectorXd free_curvature(const Load& load, const Section& section, const std::vector<geometry::Point>& positions,
                               std::size_t count);

/// Free strain beside the free curvature of a plate whose section couples, or curvature beside the strain of its plane;
/// else empty.
Eigen::VectorXd free_curvature_beside(Load load, Section section, const std::vector<geometry::Point>& positions,
                                      std::size_t count);

/// True where a temperature loads the plate.
bool heated(const Problem& problem);

}  // namespace plate
