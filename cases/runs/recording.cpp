#include "cases/runs/recording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "plate/model/process.hpp"
#include "plate/model/reduction.hpp"
#include "post/files/checkpoints.hpp"
#include "post/files/run_folder.hpp"
#include "post/files/sinks.hpp"
#include "post/report/quantity.hpp"
#include "post/report/terminal.hpp"

namespace cases {
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

/// Removes what an earlier run wrote, unless this one goes on from it.
void clear(const RecordingOptions& options, bool goes_on) {
  const auto& folder = options.folder;
  const bool same = options.goes_on && post::is_of(folder, options.resolved);  // then runs that belong to it may go on
  const auto removed = goes_on ? 0 : post::remove_earlier(folder, same ? post::Parts::stay : post::Parts::go);
  if (removed > 0 && !options.quiet)
    post::say(fmt::format("{}: removed {} files of an earlier run\n", folder.string(), removed));
}

std::unique_ptr<RunCheckpoints> checkpoints_of(const RecordingOptions& options) {
  if (options.checkpoint_every <= 0) return nullptr;
  // of the runs that may continue from one: the same case by the same build of the program
  const auto run =
      fmt::format("case {}, program {} of {}, {}", post::digest(options.resolved), options.version, plate::build(),
                  options.communicator->distributed() ? "several processes" : "one process");
  return std::make_unique<RunCheckpoints>(post::Checkpoints(*options.communicator, options.folder, run),
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
      summary->version != options.version || post::Checkpoints(*options.communicator, folder, "").any() ||
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
  plate::wait_for_all(all);
  auto checkpoints = checkpoints_of(options);
  const bool goes_on = options.goes_on && finds(checkpoints.get(), options);
  if (lock) clear(options, goes_on);
  auto sink = std::make_unique<post::Folder>(
      post::FolderOptions{options.folder, options.resolved, options.version, options.vtk, options.hdf5,
                          options.velocities, goes_on, options.communicator},
      std::move(lock));
  plate::wait_for_all(all);
  return {{std::move(sink), options.resolved, options.version, post::ProcessesOfRun(all)}, std::move(checkpoints)};
}

}  // namespace cases
