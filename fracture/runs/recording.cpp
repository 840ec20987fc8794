#include "fracture/runs/recording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fracture/runs/shared/among_ranks.hpp"
#include "plate/model/process.hpp"
#include "plate/model/ranks/ranks.hpp"
#include "post/files/digest.hpp"
#include "post/files/earlier.hpp"
#include "post/files/shared/shared_checkpoints.hpp"
#include "post/files/sinks/folder.hpp"
#include "post/files/sinks/pieces.hpp"
#include "post/report/say.hpp"
#include "post/studies/runs/read_summary.hpp"

namespace fracture {
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

/// What goes on from a checkpoint: the same case by the same build of the program.
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
