#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/shape/outline.hpp"
#include "plate/model/point_map.hpp"
#include "plate/model/state.hpp"

namespace geometry {
struct Tessellation;
}

namespace plate {

/// Two places that face each other on a crack, one on each face.
struct FacePair {
  struct Share {
    std::uint32_t point;
    double weight;
  };
  std::vector<Share> left, right;  // of points in the displacements of both places; of a distributed plate those of
                                   // owned points; the weights of each add up to 1 over all ranks
  geometry::Point position{0, 0};
  geometry::Point normal{0, 0};  // of the crack, from right to left; which face is left differs from pair to pair
  double length = 0;             // of the crack that they stand for [length]

  /// Returns this pair with its normal on the same side as a vector.
  FacePair seen_from(const geometry::Point& side) const {
    FacePair result = *this;
    if (normal.dot(side) < 0) std::swap(result.left, result.right), result.normal = -normal;
    return result;
  }

  /// Displacement (u, v) of a point in the plane along the normal; of a plate that bends that of the fibre at z = 1.
  double across(const PointValues& values) const { return normal.x() * values[2] - normal.y() * values[1]; }
  /// Opening, of a distributed plate the part of this rank.
  double opening(const State& state) const {
    double result = 0;
    for (const auto& [point, weight] : left) result += weight * across(state.col(point));
    for (const auto& [point, weight] : right) result -= weight * across(state.col(point));
    return result;
  }
  /// Adds forces that press both places apart.
  void press(double force, Forces& forces) const { press(Eigen::Vector3d(0, force, 0), forces); }

  /// Differences of both places: deflection, opening, and sliding along the normal turned by +90 degrees.
  Eigen::Vector3d jumps(const State& state) const {
    PointValues result(0, 0, 0);
    for (const auto& [point, weight] : left) result += weight * PointValues(state.col(point));
    for (const auto& [point, weight] : right) result -= weight * PointValues(state.col(point));
    return {result[0], across(result), -normal.y() * result[2] - normal.x() * result[1]};
  }
  /// Adds forces that do work on the jumps.
  void press(const Eigen::Vector3d& forces, Forces& on_points) const {
    const PointValues apart(forces[0], -forces[1] * normal.y() - forces[2] * normal.x(),
                            forces[1] * normal.x() - forces[2] * normal.y());
    for (const auto& [point, weight] : left) on_points.col(point) += weight * apart;
    for (const auto& [point, weight] : right) on_points.col(point) -= weight * apart;
  }
};

/// Points of both faces at the same places of cracks, without tips, which have one point. The faces are borders of
/// cells in opposite directions. Collective.
/// @throws NumericalError  where points of both faces do not lie at the same places
std::vector<FacePair> facing_points(const geometry::Tessellation& cells, const PointMap& map = {});

}  // namespace plate
