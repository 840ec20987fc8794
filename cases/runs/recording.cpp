#include "cases/runs/recording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "cases/runs/distributed_run.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/model/communicator.hpp"
#include "plate/model/process.hpp"
#include "plate/solve/archive.hpp"
#include "plate/solve/reduction.hpp"
#include "post/files/checkpoints.hpp"
#include "post/files/distributed_output.hpp"
#include "post/files/run_folder.hpp"
#include "post/files/sinks.hpp"
#include "post/report/quantity.hpp"
#include "post/report/terminal.hpp"

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

Keeper::Keeper(post::Checkpoints checkpoints, double every) : checkpoints_(std::move(checkpoints)), every_(every) {}

Keeper::Keeper(std::shared_ptr<post::SharedCheckpoints> checkpoints, double every)
    : together_(std::move(checkpoints)), every_(every) {}

bool Keeper::find(std::vector<std::string>& refused) {
  if (together_) {
    if (auto found = together_->read(refused)) found_ = std::move(found->memory), parts_ = std::move(found->parts);
  } else if (auto found = checkpoints_->read(refused)) {
    found_ = std::move(*found);
  }
  return goes_on();
}

void Keeper::done() const {
  together_ ? together_->remove() : checkpoints_->remove();
}

bool Keeper::recall(const std::function<void(plate::InArchive&)>& recall) {
  if (!goes_on()) return false;
  std::istringstream stream(std::exchange(found_, {}));
  plate::InArchive archive(stream);
  recall(archive);
  return true;
}

Keeper::Seconds Keeper::stretched(Seconds wanted, Seconds cost) const {
  constexpr double share = 0.01;
  return every_ < Seconds(1) ? wanted : std::max(wanted, cost / share);
}

bool Keeper::due() const {
  return Clock::now() - written_ >= stretched(every_, to_take_ + to_write_);
}

void Keeper::take(const Remember& remember) {
  const auto begin = Clock::now();
  std::ostringstream stream;
  plate::OutArchive archive(stream);
  remember(archive);
  held_ = std::move(stream).str();
  taken_ = Clock::now();
  to_take_ = taken_ - begin;
}

void Keeper::keep(const Remember& remember, const post::CellValues* own) {
  take(remember);
  write(own);
}

bool Keeper::agreed(bool here) const {
  return together_ ? plate::largest_of_all(here) > 0 : here;
}

void Keeper::hold(const Remember& remember, const std::function<post::CellValues()>& own) {
  if (agreed(Clock::now() - taken_ >= stretched(std::min(every_, Seconds(1)), to_take_))) {
    take(remember);
    if (own) held_points_ = std::make_shared<const post::CellValues>(own());
  }
  if (agreed(due())) write();
}

void Keeper::write() {
  write(held_points_.get());
  held_points_.reset();
}

void Keeper::write(const post::CellValues* own) {
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

using enum RefusedFolder::Wish;

void require_lock(const post::FolderLock& lock) {
  if (!lock.held())
    throw RefusedFolder(write, "another run writes to this folder: wait for its end, or choose another folder");
}

/// Looks for what an earlier run has kept; true where this one goes on from it.
bool finds(Keeper* keeper, const RecordingOptions& options) {
  std::vector<std::string> refused;
  const bool found = keeper && keeper->find(refused);
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

/// The sink of the run's folder, from which what an earlier one wrote is gone unless this one goes on from it.
std::unique_ptr<post::Folder> cleared(const RecordingOptions& options, bool goes_on, post::FolderLock lock) {
  const auto& [folder, resolved, version, vtk, hdf5, velocities, every, resumes, quiet] = options;
  const bool same = resumes && post::is_of(folder, resolved);  // then runs that belong to it may go on
  const auto removed = goes_on ? 0 : post::remove_earlier(folder, same ? post::Parts::stay : post::Parts::go);
  if (removed > 0 && !quiet)
    post::say(fmt::format("{}: removed {} files of an earlier run\n", folder.string(), removed));
  return std::make_unique<post::Folder>(post::FolderOptions{folder, resolved, version, vtk, hdf5, velocities, goes_on},
                                        std::move(lock));
}

void wait_for_all(const plate::Ranks& all) {
  std::array<std::int64_t, 1> ready{1};
  all.sum(ready);
}

/// Where processes share the plate: when the first has made the folder ready, all write their pieces into it.
Recording shared_recording(const plate::Ranks& all, const RecordingOptions& options) {
  std::optional<post::FolderLock> lock;
  if (speaks()) {
    std::filesystem::create_directories(options.folder);
    lock.emplace(options.folder);
    require_lock(*lock);
  }
  wait_for_all(all);
  std::unique_ptr<Keeper> keeper;
  if (options.checkpoint_every > 0)
    keeper = std::make_unique<Keeper>(std::make_shared<post::SharedCheckpoints>(all, options.folder, run_of(options)),
                                      options.checkpoint_every);
  const bool goes_on = options.goes_on && finds(keeper.get(), options);
  auto sink = lock ? cleared(options, goes_on, std::move(*lock)) : nullptr;
  wait_for_all(all);
  std::optional<post::StateFile::Options> stored;
  if (options.hdf5)
    stored = {options.folder / "state.h5", options.resolved, options.version, options.velocities, goes_on};
  return {{std::make_unique<post::Pieces>(all, options.folder, options.vtk, std::move(stored), std::move(sink)),
           options.resolved, options.version},
          std::move(keeper)};
}

}  // namespace

void check_folder(const std::filesystem::path& folder) {
  if (!speaks()) return;
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
  if (const auto* all = plate::ranks()) return shared_recording(*all, options);
  std::filesystem::create_directories(options.folder);
  post::FolderLock lock(options.folder);
  require_lock(lock);
  std::unique_ptr<Keeper> keeper;
  if (options.checkpoint_every > 0)
    keeper = std::make_unique<Keeper>(post::Checkpoints(options.folder, run_of(options)), options.checkpoint_every);
  const bool goes_on = options.goes_on && finds(keeper.get(), options);
  return {{cleared(options, goes_on, std::move(lock)), options.resolved, options.version}, std::move(keeper)};
}

}  // namespace fracture
