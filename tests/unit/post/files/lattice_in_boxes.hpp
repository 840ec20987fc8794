#pragma once
#include <cmath>

#include "plate/model/communicator.hpp"
#include "post/files/frame.hpp"

/// A lattice with a gap in some rows, shared out in columns and rows of boxes, and numbers that tell points apart.
namespace lattice_in_boxes {

constexpr int columns = 420, rows = 200;  // 82,000 points: more than come at once

inline bool there(int column, int row) {
  return row % 40 >= 20 || column < 380;
}

/// The box of a place: two columns of boxes, so many rows of them.
inline int owner(int column, int row, int processes) {
  if (processes == 1) return 0;
  const int up = (processes + 1) / 2, box = 2 * (row * up / rows) + (column >= 170 ? 1 : 0);
  return box % processes;
}

/// Own points row by row; all of one process.
inline post::Mesh own_mesh(int rank, int processes) {
  post::Mesh mesh;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      if (!there(column, row) || owner(column, row, processes) != rank) continue;
      mesh.positions.emplace_back(0.1 + 0.01 * (column + 0.5), -0.2 + 0.01 * (row + 0.5));
      mesh.areas.push_back(1 + row * 1000 + column), mesh.cut.push_back(1.0 / (1 + row * 1000 + column));
    }
  mesh.spacing = 0.01, mesh.thickness = 0.1;
  return mesh;
}

inline plate::State state(const post::Mesh& mesh, double time) {
  plate::State result(3, Eigen::Index(mesh.positions.size()));
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    const auto& x = mesh.positions[k];
    result.col(Eigen::Index(k)) << std::sin(3 * x.x() + time) * x.y(), std::cos(2 * x.y()) + time, x.x() * x.y();
  }
  return result;
}

}  // namespace lattice_in_boxes
