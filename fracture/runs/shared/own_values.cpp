#include "fracture/runs/shared/own_values.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "geometry/lattice/cell_index.hpp"
#include "plate/formulation/boundary.hpp"

namespace fracture {
namespace {

/// The cell of a point; where cells are not enough to tell points, its number stands for it.
geometry::Cell cell_of(const plate::Boundary& boundary, std::uint32_t k) {
  return boundary.number.empty() ? geometry::cell_of(boundary.lattice[k]) : geometry::Cell{boundary.number[k], 0};
}

/// Points by these.
class Found {
public:
  explicit Found(const plate::Boundary& boundary) : boundary_(boundary) {
    if (boundary.number.empty()) index_.emplace(boundary.lattice);
  }
  std::optional<std::uint32_t> at(const geometry::Cell& cell) const {
    if (index_) return index_->at({double(cell[0]) + 0.5, double(cell[1]) + 0.5});
    const auto found = std::ranges::lower_bound(boundary_.number, std::uint32_t(cell[0]));
    if (found == boundary_.number.end() || *found != std::uint32_t(cell[0])) return std::nullopt;
    return std::uint32_t(found - boundary_.number.begin());
  }

private:
  const plate::Boundary& boundary_;
  std::optional<geometry::CellIndex> index_;
};

std::vector<std::uint32_t> own_points(const plate::Boundary& boundary) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t k = 0; k < boundary.cloud.plate_points; ++k)
    if (boundary.owns(k)) result.push_back(k);
  return result;
}

geometry::CellBox box_of(const plate::Boundary& boundary, const std::vector<std::uint32_t>& points) {
  geometry::CellBox box;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto cell = cell_of(boundary, points[i]);
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
    result.cells.push_back(cell_of(boundary, k));
    for (const auto* state : states)
      for (int c = 0; state->cols() > 0 && c < 3; ++c) result.values.push_back((*state)(c, k));
  }
  return result;
}

void put_values(const plate::Boundary& boundary, const std::vector<std::filesystem::path>& files,
                const std::vector<plate::State*>& states) {
  const auto points = own_points(boundary);
  const Found points_by_cells(boundary);
  for (auto* state : states) state->setZero(3, Eigen::Index(boundary.cloud.size()));
  std::size_t found = 0, width = 0;
  for (const auto& path : files)
    width = post::read_cells(path, box_of(boundary, points), [&](const geometry::Cell& cell, auto values) {
      const auto k = points_by_cells.at(cell);
      if (!k || !boundary.is_plate(*k) || !boundary.owns(*k)) return;
      for (std::size_t i = 0; i < std::min(3 * states.size(), values.size()); ++i)
        (*states[i / 3])(Eigen::Index(i % 3), Eigen::Index(*k)) = values[i];
      ++found;
    });
  if (found != points.size()) throw std::runtime_error("the checkpoint does not have all points of the plate");
  for (std::size_t i = width / 3; i < states.size(); ++i) states[i]->resize(3, 0);
}

}  // namespace fracture
