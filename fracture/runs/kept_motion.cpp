#include "fracture/runs/kept_motion.hpp"

#include <stdexcept>

#include "fracture/growth/motion/moving_growth.hpp"
#include "fracture/runs/results.hpp"
#include "fracture/runs/shared/among_ranks.hpp"
#include "geometry/lattice/cell_index.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/solve/archive.hpp"
#include "plate/solve/reduction.hpp"

namespace fracture {
namespace {

/// Points that no other process has.
std::vector<std::uint32_t> own_points(const plate::Boundary& boundary) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t k = 0; k < boundary.cloud.plate_points; ++k)
    if (boundary.owns(k)) result.push_back(k);
  return result;
}

/// The columns of some states side by side, of these points. A state that is not there yet is left out.
post::CellValues values_of(const plate::Boundary& boundary, const std::vector<const plate::State*>& states) {
  post::CellValues result;
  const auto points = own_points(boundary);
  for (const auto* state : states) result.width += state->cols() > 0 ? 3 : 0;
  result.cells.reserve(points.size()), result.values.reserve(points.size() * result.width);
  for (const auto k : points) {
    result.cells.push_back(geometry::cell_of(boundary.lattice[k]));
    for (const auto* state : states)
      if (state->cols() > 0) result.values.insert(result.values.end(), state->col(k).begin(), state->col(k).end());
  }
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

void KeptMotion::keep_to(Keeper& keeper, plate::DynamicOptions& options) {
  options.due = [&] { return plate::largest_of_all(keeper.due()) > 0; };
  options.keep = [&](const plate::MotionMemory& now) { shared() ? keep_part(keeper, now) : keep(keeper, now); };
  if (recall(keeper)) options.from = &memory_;
}

void KeptMotion::keep(Keeper& keeper, const plate::MotionMemory& now) {
  keeper.keep([&](plate::OutArchive& archive) {
    archive(now);
    results_.remember(archive);
    if (growth_) growth_->remember(archive);
  });
}

void KeptMotion::keep_part(Keeper& keeper, const plate::MotionMemory& now) {
  keeper.keep(
      [&](plate::OutArchive& archive) {
        archive(plate::MotionMemory{now.step, {}, {}, now.loads, now.work, now.before});
        results_.remember(archive);
      },
      values_of(plate_.boundary(), {&now.state, &now.velocity, &results_.state_of_largest()}));
}

bool KeptMotion::recall(Keeper& keeper) {
  const bool found = keeper.recall([&](plate::InArchive& archive) {
    archive(memory_);
    results_.recall(archive);
    if (growth_) growth_->recall(archive);
  });
  if (found && shared()) recall_part(keeper);
  return found;
}

void KeptMotion::recall_part(const Keeper& keeper) {
  const auto& boundary = plate_.boundary();
  const auto points = own_points(boundary);
  const geometry::CellIndex index(boundary.lattice);
  auto& largest = results_.state_of_largest();
  for (auto* state : {&memory_.state, &memory_.velocity, &largest})
    state->setZero(3, Eigen::Index(boundary.cloud.size()));
  std::size_t found = 0, width = 0;
  for (const auto& path : keeper.parts())
    width = post::read_cells(path, box_of(boundary, points), [&](const geometry::Cell& cell, auto values) {
      const auto k = index.at({double(cell[0]) + 0.5, double(cell[1]) + 0.5});
      if (!k || !boundary.is_plate(*k) || !boundary.owns(*k)) return;
      memory_.state.col(*k) = Eigen::Map<const Eigen::Vector3d>(values.data());
      memory_.velocity.col(*k) = Eigen::Map<const Eigen::Vector3d>(values.data() + 3);
      if (values.size() > 6) largest.col(*k) = Eigen::Map<const Eigen::Vector3d>(values.data() + 6);
      ++found;
    });
  if (found != points.size()) throw std::runtime_error("the checkpoint does not have all points of the plate");
  if (width < 9) largest.resize(3, 0);
  plate_.constraints().impose(memory_.state);
  if (largest.cols() > 0) plate_.constraints().impose(largest);
}

}  // namespace fracture
