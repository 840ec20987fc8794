#include "cases/runs/recording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/model/communicator.hpp"
#include "plate/model/process.hpp"
#include "plate/model/space.hpp"
#include "plate/solve/archive.hpp"
#include "post/files/checkpoints.hpp"
#include "post/files/run_folder.hpp"
#include "post/files/sinks.hpp"
#include "post/report/quantity.hpp"
#include "post/report/terminal.hpp"

namespace fracture {
namespace {

/// The cell of a point; where cells are not enough to tell points, its number stands for it.
geometry::Cell cell_of(const plate::Boundary& boundary, std::uint32_t k) {
  return boundary.map.global.empty() ? geometry::cell_of(boundary.lattice[k])
                                     : geometry::Cell{boundary.map.global[k], 0};
}

/// Points by these.
class Found {
public:
  explicit Found(const plate::Boundary& boundary) : boundary_(boundary) {
    if (boundary.map.global.empty()) index_.emplace(boundary.lattice);
  }
  std::optional<std::uint32_t> at(const geometry::Cell& cell) const {
    if (index_) return index_->at({double(cell[0]) + 0.5, double(cell[1]) + 0.5});
    const auto found = std::ranges::lower_bound(boundary_.map.global, std::uint32_t(cell[0]));
    if (found == boundary_.map.global.end() || *found != std::uint32_t(cell[0])) return std::nullopt;
    return std::uint32_t(found - boundary_.map.global.begin());
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
                const std::vector<plate::State*>& states) {
  const auto points = own_points(boundary);
  const Found points_by_cells(boundary);
  for (auto* state : states) state->setZero(plate::unknowns_per_point, Eigen::Index(boundary.cloud.size()));
  std::size_t found = 0, width = 0;
  for (const auto& path : files)
    width = post::read_cells(path, box_of(boundary, points), [&](const geometry::Cell& cell, auto values) {
      const auto k = points_by_cells.at(cell);
      if (!k || !boundary.is_plate(*k) || !boundary.owns(*k)) return;
      for (std::size_t i = 0; i < std::min(plate::unknowns_per_point * states.size(), values.size()); ++i)
        (*states[plate::point_of(i)])(Eigen::Index(plate::component_of(i)), Eigen::Index(*k)) = values[i];
      ++found;
    });
  if (found != points.size()) throw std::runtime_error("the checkpoint does not have all points of the plate");
  for (std::size_t i = width / plate::unknowns_per_point; i < states.size(); ++i)
    states[i]->resize(plate::unknowns_per_point, 0);
}

RunCheckpoints::RunCheckpoints(post::Checkpoints checkpoints, double every)
    : checkpoints_(std::move(checkpoints)), every_(every) {}

RunCheckpoints::RunCheckpoints(std::shared_ptr<post::DistributedCheckpoints> checkpoints, double every)
    : together_(std::move(checkpoints)), every_(every) {}

bool RunCheckpoints::find(std::vector<std::string>& refused) {
  if (together_) {
    if (auto found = together_->read(refused)) found_ = std::move(found->memory), parts_ = std::move(found->parts);
  } else if (auto found = checkpoints_->read(refused)) {
    found_ = std::move(*found);
  }
  return goes_on();
}

void RunCheckpoints::done() const {
  together_ ? together_->remove() : checkpoints_->remove();
}

bool RunCheckpoints::restore(const std::function<void(plate::InArchive&)>& restore) {
  if (!goes_on()) return false;
  std::istringstream stream(std::exchange(found_, {}));
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

void RunCheckpoints::take(const SaveState& save_state) {
  const auto begin = Clock::now();
  std::ostringstream stream;
  plate::OutArchive archive(stream);
  save_state(archive);
  held_ = std::move(stream).str();
  taken_ = Clock::now();
  to_take_ = taken_ - begin;
}

void RunCheckpoints::save(const SaveState& save_state, const post::CellValues* own) {
  take(save_state);
  write(own);
}

bool RunCheckpoints::agreed(bool here) const {
  return together_ ? together_->communicator().largest_of(here) > 0 : here;
}

void RunCheckpoints::hold(const SaveState& save_state, const std::function<post::CellValues()>& own) {
  if (agreed(Clock::now() - taken_ >= limited_interval(std::min(every_, Seconds(1)), to_take_))) {
    take(save_state);
    if (own) held_points_ = std::make_shared<const post::CellValues>(own());
  }
  if (agreed(due())) write();
}

void RunCheckpoints::write() {
  write(held_points_.get());
  held_points_.reset();
}

void RunCheckpoints::write(const post::CellValues* own) {
  if (held_.empty()) return;
  const auto begin = Clock::now();
  try {
    if (together_)
      together_->write(held_, own ? *own : post::CellValues{});
    else
      checkpoints_->write(held_);
  } catch (const std::filesystem::filesystem_error& error) {
    if (!std::exchange(failed_, true)) post::say(fmt::format("no checkpoint: {}\n", error.what()));
  }
  held_.clear();
  held_.shrink_to_fit();
  written_ = Clock::now();
  to_write_ = written_ - begin;
}

namespace {

using enum RefusedFolder::Attempt;

void require_lock(const post::FolderLock& lock) {
  if (!lock.held())
    throw RefusedFolder(write, "another run writes to this folder: wait for its end, or choose another folder");
}

/// Looks for what an earlier run has kept; true where this one goes on from it.
bool finds(RunCheckpoints* checkpoints, const RecordingOptions& options) {
  std::vector<std::string> refused;
  const bool found = checkpoints && checkpoints->find(refused);
  if (!found && !refused.empty()) throw RefusedFolder(go_on, fmt::format("{}", fmt::join(refused, "; ")));
  for (const auto& one : refused) post::say(one + ": goes on from the one before\n");
  if (!options.quiet)
    post::say(fmt::format("{}: {}\n", options.folder.string(),
                          found ? "goes on from the last checkpoint" : "there is no checkpoint: begins anew"));
  return found;
}

/// Identifies the runs that may continue from a checkpoint: the same case by the same build of the program.
std::string run_of(const RecordingOptions& options) {
  return fmt::format("case {}, program {} of {}", post::digest(options.resolved), options.version, plate::build());
}

/// Removes what an earlier run wrote, unless this one goes on from it.
void clear(const RecordingOptions& options, bool goes_on) {
  const auto& folder = options.folder;
  const bool same = options.goes_on && post::is_of(folder, options.resolved);  // then runs that belong to it may go on
  const auto removed = goes_on ? 0 : post::remove_earlier(folder, same ? post::Parts::stay : post::Parts::go);
  if (removed > 0 && !options.quiet)
    post::say(fmt::format("{}: removed {} files of an earlier run\n", folder.string(), removed));
}

void wait_for_all(const plate::Communicator& all) {
  std::array<std::int64_t, 1> ready{1};
  all.sum(ready);
}

std::unique_ptr<RunCheckpoints> checkpoints_of(const RecordingOptions& options) {
  const auto& [all, folder] = std::tie(*options.communicator, options.folder);
  if (options.checkpoint_every <= 0) return nullptr;
  if (!all.distributed())
    return std::make_unique<RunCheckpoints>(post::Checkpoints(folder, run_of(options)), options.checkpoint_every);
  return std::make_unique<RunCheckpoints>(std::make_shared<post::DistributedCheckpoints>(all, folder, run_of(options)),
                                          options.checkpoint_every);
}

}  // namespace

void check_folder(const std::filesystem::path& folder) {
  constexpr std::size_t most = 3;
  require_lock(post::FolderLock(folder));
  auto found = post::strangers(folder);
  if (found.empty()) return;
  if (found.size() > most) found.resize(most), found.back() = "...";
  throw RefusedFolder(write, fmt::format("holds {}, but no results of a run: choose another folder, or empty it",
                                         fmt::join(found, ", ")));
}

std::optional<post::Summary> done_before(const RecordingOptions& options, bool report) {
  const auto& folder = options.folder;
  auto summary = post::read_summary(folder / "summary.json");
  if (!summary || summary->outcome != "done" || summary->digest != post::digest(options.resolved) ||
      summary->version != options.version || post::Checkpoints(folder, "").any() ||
      (report && !std::filesystem::exists(folder / "report.html")))
    return std::nullopt;
  if (!options.quiet) post::say(folder.string() + ": this run is done already\n");
  return summary;
}

Recording recording(const RecordingOptions& options) {
  const auto& all = *options.communicator;
  std::optional<post::FolderLock> lock;
  if (all.rank() == 0) {
    std::filesystem::create_directories(options.folder);
    require_lock(lock.emplace(options.folder));
  }
  wait_for_all(all);
  auto checkpoints = checkpoints_of(options);
  const bool goes_on = options.goes_on && finds(checkpoints.get(), options);
  if (lock) clear(options, goes_on);
  auto sink = std::make_unique<post::Folder>(
      post::FolderOptions{options.folder, options.resolved, options.version, options.vtk, options.hdf5,
                          options.velocities, goes_on, options.communicator},
      std::move(lock));
  wait_for_all(all);
  return {{std::move(sink), options.resolved, options.version, all}, std::move(checkpoints)};
}

}  // namespace fracture
