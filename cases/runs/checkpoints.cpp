#include "cases/runs/checkpoints.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/model/space.hpp"
#include "plate/solve/archive.hpp"
#include "post/report/terminal.hpp"

namespace cases {
namespace {

/// True where this rank saves all columns of a state: nothing is computed again, fictitious points neither.
bool saves_all(const plate::Boundary& boundary) {
  return !boundary.map.distributed();
}

bool saves(const plate::Boundary& boundary, std::uint32_t k) {
  return saves_all(boundary) || (boundary.is_plate(k) && boundary.owns(k));
}

/// The cell of a point; where cells are not enough to tell points, its number stands for it.
geometry::Cell cell_of(const plate::Boundary& boundary, std::uint32_t k) {
  if (saves_all(boundary)) return {k, 0};
  return boundary.map.global.empty() ? geometry::cell_of(boundary.lattice[k])
                                     : geometry::Cell{boundary.map.global[k], 0};
}

/// Points that this rank saves, by their cells.
class PointsByCells {
public:
  explicit PointsByCells(const plate::Boundary& boundary) : boundary_(boundary) {
    const auto end = boundary.lattice.begin() + std::ptrdiff_t(boundary.cloud.plate_points);
    if (!saves_all(boundary) && boundary.map.global.empty())
      index_.emplace(std::vector<geometry::Point>(boundary.lattice.begin(), end));
  }
  /// Local index of the point; nothing where this rank does not save it.
  std::optional<std::uint32_t> at(const geometry::Cell& cell) const {
    const auto k = index_                 ? index_->at({double(cell[0]) + 0.5, double(cell[1]) + 0.5})
                   : saves_all(boundary_) ? std::uint32_t(cell[0])
                                          : numbered(std::uint32_t(cell[0]));
    return k && *k < boundary_.cloud.size() && saves(boundary_, *k) ? k : std::nullopt;
  }

private:
  std::optional<std::uint32_t> numbered(std::uint32_t number) const {
    const auto& global = boundary_.map.global;
    const auto found = std::ranges::lower_bound(global, number);
    if (found == global.end() || *found != number) return std::nullopt;
    return std::uint32_t(found - global.begin());
  }

  const plate::Boundary& boundary_;
  std::optional<geometry::CellIndex> index_;
};

std::vector<std::uint32_t> saved_points(const plate::Boundary& boundary) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t k = 0; k < boundary.cloud.size(); ++k)
    if (saves(boundary, k)) result.push_back(k);
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
  const auto points = saved_points(boundary);
  for (const auto* state : states) result.width += state->cols() > 0 ? plate::unknowns_per_point : 0;
  result.cells.reserve(points.size()), result.values.reserve(points.size() * result.width);
  for (const auto k : points) {
    result.cells.push_back(cell_of(boundary, k));
    for (const auto* state : states)
      for (int c = 0; state->cols() > 0 && c < plate::unknowns_per_point; ++c) result.values.push_back((*state)(c, k));
  }
  return result;
}

void put_values(const plate::Boundary& boundary, const std::vector<std::filesystem::path>& files,
                const std::vector<RestoredState>& states) {
  const auto points = saved_points(boundary);
  const PointsByCells points_by_cells(boundary);
  for (const auto& one : states) one.state->setZero(plate::unknowns_per_point, Eigen::Index(boundary.cloud.size()));
  std::size_t found = 0, width = 0;
  for (const auto& path : files)
    width = post::read_cells(path, box_of(boundary, points), [&](const geometry::Cell& cell, auto values) {
      const auto k = points_by_cells.at(cell);
      if (!k) return;
      for (std::size_t s = 0, i = 0; s < states.size() && i < values.size(); ++s)
        for (auto& value : states[s].state->col(*k)) value = values[i++];
      ++found;
    });
  if (found != points.size()) throw std::runtime_error("the checkpoint does not have all points of the plate");
  for (std::size_t i = 0; i < states.size(); ++i)
    if (const auto& [state, complete] = states[i]; i >= width / plate::unknowns_per_point)
      state->resize(plate::unknowns_per_point, 0);
    else if (complete && !saves_all(boundary))
      complete(*state);
}

bool RunCheckpoints::find(std::vector<std::string>& refused) {
  if (auto found = checkpoints_.read(refused)) found_ = std::move(*found);
  return goes_on();
}

bool RunCheckpoints::restore(const std::function<void(plate::InArchive&)>& restore) {
  if (!goes_on()) return false;
  std::istringstream stream(std::exchange(found_.memory, {}));
  plate::InArchive archive(stream);
  restore(archive);
  return true;
}

RunCheckpoints::Seconds RunCheckpoints::limited_interval(Seconds wanted, Seconds cost) const {
  constexpr double share = 0.01;
  return every_ < Seconds(1) ? wanted : std::max(wanted, cost / share);
}

bool RunCheckpoints::due() const {
  return Clock::now() - written_ >= limited_interval(every_, to_take_ + to_write_);
}

void RunCheckpoints::take(const SaveState& save_state, const OwnValues& own) {
  const auto begin = Clock::now();
  std::ostringstream stream;
  plate::OutArchive archive(stream);
  save_state(archive);
  held_ = std::move(stream).str();
  held_points_ = {};  // there are never two
  held_points_ = own();
  taken_ = Clock::now();
  to_take_ = taken_ - begin;
}

void RunCheckpoints::save(const SaveState& save_state, const OwnValues& own) {
  take(save_state, own);
  write();
}

void RunCheckpoints::hold(const SaveState& save_state, const OwnValues& own) {
  if (agreed(Clock::now() - taken_ >= limited_interval(std::min(every_, Seconds(1)), to_take_))) take(save_state, own);
  if (agreed(due())) write();
}

void RunCheckpoints::write() {
  if (held_.empty()) return;
  const auto begin = Clock::now();
  try {
    checkpoints_.write(held_, held_points_);
  } catch (const post::CheckpointNotWritten& error) {
    if (!std::exchange(failed_, true)) post::say(fmt::format("no checkpoint: {}\n", error.what()));
  }
  held_.clear();
  held_.shrink_to_fit();
  held_points_ = {};
  written_ = Clock::now();
  to_write_ = written_ - begin;
}

}  // namespace cases
