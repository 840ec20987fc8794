#pragma once
#include <memory>

#include "plate/model/loads.hpp"
#include "plate/model/state.hpp"

namespace geometry {
struct Cloud;
struct Tessellation;
}  // namespace geometry

namespace plate {

struct MovingForces;

/// A load case: generalised nodal forces times a factor of time; of a settlement none, but where it puts what is held
/// while all that is free rests (Constraints::lift).
struct TimedLoad {
  Forces forces;
  History history;
  /// kappa_0 of a temperature at every point of the plate [1 / length]; of other loads empty.
  Eigen::VectorXd curvature = {};
  State lift = State(3, 0);
  std::shared_ptr<const MovingForces> moving = {};  // of a load that moves along a path; `forces` are zero

  bool lifts() const { return lift.cols() > 0; }
};

/// Generalised nodal forces (3 x points: work-conjugate to w, theta_x, theta_y) of one load at factor 1.
/// A temperature, whose forces are of the formulation, gives none, nor do loads that move (moving_forces()).
/// Edge loads act on the edge line: what a point takes over is moved to it with the couple of its lever.
/// `outline` is in the cloud's own units; `own`: points that no other process has, empty: all; `cracks`: a line load
/// stays on its side of them. Throws std::invalid_argument for an edge without points beside it.
Forces nodal_forces(const Load& load, const geometry::Cloud& cloud, const geometry::Outline& outline,
                    const std::vector<char>& own = {}, const std::vector<geometry::CrackPath>& cracks = {});

/// The same on points that lie on the edges: half of every piece of an edge at either end, with the couples that make a
/// shear force do the right work on deflections of the third order. `areas` of the points [length^2].
Forces nodal_forces(const Load& load, const geometry::Tessellation& cells, const std::vector<double>& areas,
                    const std::vector<char>& own = {});

}  // namespace plate
