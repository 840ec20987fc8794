#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "plate/model/state.hpp"

namespace geometry {
struct Cloud;
struct Tessellation;
}  // namespace geometry

namespace plate {

struct Load;

/// Nodal forces of a load that moves along a path: at a few points each time, linear in time between stations. Where
/// processes share the plate, those on the points that one sees.
struct MovingForces {
  struct Station {
    double time;
    std::vector<std::pair<std::uint32_t, double>> forces;  // of degrees of freedom 3 * point + component, ascending
  };
  std::vector<Station> stations;  // by time; nothing acts before the first and after the last
  std::vector<char> own = {};     // points that no other process has; empty: all

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

/// Of a load with a path and a speed, from time 0 on. `own`: points that no other process has, empty: all.
MovingForces moving_forces(const Load& load, const geometry::Cloud& cloud, const std::vector<char>& own = {});
MovingForces moving_forces(const Load& load, const geometry::Tessellation& cells, std::size_t points,
                           const std::vector<char>& own = {});

}  // namespace plate
