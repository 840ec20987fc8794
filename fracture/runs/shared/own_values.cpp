#include "fracture/runs/shared/own_values.hpp"

#include <algorithm>
#include <stdexcept>

#include "geometry/lattice/cell_index.hpp"
#include "plate/formulation/boundary.hpp"

namespace fracture {
namespace {

std::vector<std::uint32_t> own_points(const plate::Boundary& boundary) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t k = 0; k < boundary.cloud.plate_points; ++k)
    if (boundary.owns(k)) result.push_back(k);
  return result;
}

geometry::CellBox box_of(const plate::Boundary& boundary, const std::vector<std::uint32_t>& points) {
  geometry::CellBox box;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto cell = geometry::cell_of(boundary.lattice[points[i]]);
    for (const std::size_t axis : {0, 1}) {
      box.low[axis] = i == 0 ? cell[axis] : std::min(box.low[axis], cell[axis]);
      box.high[axis] = i == 0 ? cell[axis] + 1 : std::max(box.high[axis], cell[axis] + 1);
    }
  }
  return box;
}

}  // namespace

post::CellValues own_values(const plate::Boundary& boundary, const std::vector<const plate::State*>& states) {
  post::CellValues result;
  const auto points = own_points(boundary);
  for (const auto* state : states) result.width += state->cols() > 0 ? 3 : 0;
  result.cells.reserve(points.size()), result.values.reserve(points.size() * result.width);
  for (const auto k : points) {
    result.cells.push_back(geometry::cell_of(boundary.lattice[k]));
    for (const auto* state : states)
      for (int c = 0; state->cols() > 0 && c < 3; ++c) result.values.push_back((*state)(c, k));
  }
  return result;
}

void put_values(const plate::Boundary& boundary, const std::vector<std::filesystem::path>& files,
                const std::vector<plate::State*>& states) {
  const auto points = own_points(boundary);
  const geometry::CellIndex index(boundary.lattice);
  for (auto* state : states) state->setZero(3, Eigen::Index(boundary.cloud.size()));
  std::size_t found = 0, width = 0;
  for (const auto& path : files)
    width = post::read_cells(path, box_of(boundary, points), [&](const geometry::Cell& cell, auto values) {
      const auto k = index.at({double(cell[0]) + 0.5, double(cell[1]) + 0.5});
      if (!k || !boundary.is_plate(*k) || !boundary.owns(*k)) return;
      for (std::size_t i = 0; i < std::min(3 * states.size(), values.size()); ++i)
        (*states[i / 3])(Eigen::Index(i % 3), Eigen::Index(*k)) = values[i];
      ++found;
    });
  if (found != points.size()) throw std::runtime_error("the checkpoint does not have all points of the plate");
  for (std::size_t i = width / 3; i < states.size(); ++i) states[i]->resize(3, 0);
}

}  // namespace fracture
