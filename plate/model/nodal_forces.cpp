#include "plate/model/nodal_forces.hpp"

#include <algorithm>
#include <cmath>
#include "geometry/cells/tessellation.hpp"
#include "plate/model/loading/edge_pieces.hpp"
#include "plate/model/loading/spread.hpp"
#include "plate/model/state.hpp"

namespace plate {
namespace {

using geometry::Point;

/// Couple of a moment tensor M (tension on z > 0 positive) on an edge with normal n: work M n . (u, v)/z.
Eigen::Vector3d edge_couple(const Load& load, const Point& normal) {
  if (load.has_tensor) {
    const auto [xx, yy, xy] = load.tensor;
    return {0, -(xy * normal.x() + yy * normal.y()), xx * normal.x() + xy * normal.y()};
  }
  const Point along(-normal.y(), normal.x());
  const Point moment = load.value * normal + load.twist * along;
  return {0, -moment.y(), moment.x()};
}

void add_edge_load(const Load& load, const geometry::Cloud& cloud, const geometry::Outline& outline, Forces& forces) {
  for (const auto& name : load.edges)
    for (const EdgeBorder& border : edge_borders(name, cloud, outline))
      for (const EdgePiece& piece : border.pieces) {
        const auto k = nearest(border.near, cloud, piece.middle);
        const Point lever = piece.middle - cloud.positions[k];
        forces.col(k) += load.kind == Load::Kind::edge_moment ? edge_couple(load, piece.normal)
                                                              : moved_force(load.value * piece.normal.norm(), lever);
      }
}

void add_edge_load(const Load& load, const geometry::Tessellation& cells, Forces& forces) {
  for (const auto& border : cells.borders) {
    if (border.edge == geometry::Curves::crack) continue;
    const auto& name = cells.names[std::size_t(border.edge)];
    if (std::find(load.edges.begin(), load.edges.end(), name) == load.edges.end()) continue;
    const Point along = cells.positions[border.to] - cells.positions[border.from];
    for (const int end : {1, -1}) {
      const auto k = end > 0 ? border.from : border.to;
      // a force q on a piece from 0 to l, deflections by the third-order line through both ends: q l^2 / 12 on the
      // slopes
      forces.col(k) += load.kind == Load::Kind::edge_moment
                           ? edge_couple(load, Point(along.y(), -along.x()) / 2)
                           : moved_force(load.value * along.norm() / 2, Point(along * (end / 6.0)));
    }
  }
}

}  // namespace

Forces nodal_forces(const Load& load, const geometry::Tessellation& cells, const std::vector<double>& areas,
                    const std::vector<char>& own) {
  Forces forces = Forces::Zero(3, static_cast<Eigen::Index>(areas.size()));
  if (load.moves()) return forces;
  switch (load.kind) {
    case Load::Kind::pressure:
      for (std::size_t k = 0; load.uniform() && k < areas.size(); ++k)
        forces(0, Eigen::Index(k)) = load.value * areas[k];
      if (!load.uniform()) add_pressure(load, cells, own, forces);
      break;
    case Load::Kind::line_load:
      add_line_load(load, cells, forces);
      break;
    case Load::Kind::point_force: {
      if (!cells.sees(load.position)) break;
      std::size_t nearest = 0;
      for (std::size_t k = 0; k < areas.size(); ++k)
        if ((cells.positions[k] - load.position).squaredNorm() <
            (cells.positions[nearest] - load.position).squaredNorm())
          nearest = k;
      forces.col(Eigen::Index(nearest)) = moved_force(load.value, load.position - cells.positions[nearest]);
      break;
    }
    case Load::Kind::edge_moment:
    case Load::Kind::edge_shear:
      add_edge_load(load, cells, forces);
      break;
    case Load::Kind::temperature:
    case Load::Kind::settlement:
      break;
  }
  return forces;
}

Forces nodal_forces(const Load& load, const geometry::Cloud& cloud, const geometry::Outline& outline,
                    const std::vector<char>& own, const std::vector<geometry::CrackPath>& cracks) {
  Forces forces = Forces::Zero(3, static_cast<Eigen::Index>(cloud.size()));
  if (load.moves()) return forces;
  switch (load.kind) {
    case Load::Kind::pressure:
      for (std::uint32_t k = 0; load.uniform() && k < cloud.plate_points; ++k)
        forces(0, k) = load.value * cloud.areas[k];
      if (!load.uniform()) add_pressure(load, cloud, own, forces);
      break;
    case Load::Kind::line_load:
      add_line_load(load, cloud, cracks, forces);
      break;
    case Load::Kind::point_force: {
      if (!cloud.seeded(load.position)) break;
      const auto k = geometry::nearest_plate_point(cloud, load.position);
      forces.col(static_cast<Eigen::Index>(k)) = moved_force(load.value, load.position - cloud.positions[k]);
      break;
    }
    case Load::Kind::edge_moment:
    case Load::Kind::edge_shear:
      add_edge_load(load, cloud, outline, forces);
      break;
    case Load::Kind::temperature:
    case Load::Kind::settlement:
      break;
  }
  return forces;
}

}  // namespace plate
