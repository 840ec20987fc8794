#include "cases/driver/recording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cases/input/case_file.hpp"
#include "plate/model/membrane.hpp"
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
bool finds(RunCheckpoints* checkpoints, const RunOptions& options) {
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
void clear(const RunOptions& options, const std::string& resolved, bool goes_on) {
  const auto& folder = options.folder;
  const bool same = options.resume && post::is_of(folder, resolved);  // then runs that belong to it may go on
  const auto removed = goes_on ? 0 : post::remove_earlier(folder, same ? post::Parts::stay : post::Parts::go);
  if (removed > 0 && !options.quiet)
    post::say(fmt::format("{}: removed {} files of an earlier run\n", folder.string(), removed));
}

std::unique_ptr<RunCheckpoints> checkpoints_of(const RunPlan& plan, const std::string& resolved) {
  const double every = plan.content.output.checkpoint_every;
  if (every <= 0) return nullptr;
  const auto& all = *plan.options.communicator;
  // of the runs that may continue from one: the same case by the same build of the program
  const auto run = fmt::format("case {}, program {} of {}, {}", post::digest(resolved), PDPLATE_VERSION, plate::build(),
                               all.distributed() ? "several processes" : "one process");
  return std::make_unique<RunCheckpoints>(post::Checkpoints(all, plan.options.folder, run), every);
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

std::optional<post::Summary> done_before(const RunPlan& plan) {
  const auto& [c, options] = plan;
  const auto& folder = options.folder;
  auto summary = post::read_summary(folder / "summary.json");
  if (!summary || summary->outcome != "done" || summary->digest != post::digest(resolved_toml(c)) ||
      summary->version != PDPLATE_VERSION || post::Checkpoints(*options.communicator, folder, "").any() ||
      (c.output.reports() && !std::filesystem::exists(folder / "report.html")))
    return std::nullopt;
  if (!options.quiet) post::say(folder.string() + ": this run is done already\n");
  return summary;
}

Recording recording(const RunPlan& plan) {
  const auto& [c, options] = plan;
  const auto resolved = resolved_toml(c);
  if (auto* in_memory = options.in_memory) {
    in_memory->resolved = resolved;
    in_memory->wants_fields = in_memory->wants_fields && (c.output.vtk || c.output.hdf5);
    return {{std::make_unique<post::MemorySink>(*in_memory), resolved, PDPLATE_VERSION}, nullptr};
  }
  const auto& all = *options.communicator;
  std::optional<post::FolderLock> lock;
  if (all.rank() == 0) {
    std::filesystem::create_directories(options.folder);
    require_lock(lock.emplace(options.folder));
  }
  plate::wait_for_all(all);
  auto checkpoints = checkpoints_of(plan, resolved);
  const bool goes_on = options.resume && finds(checkpoints.get(), options);
  if (lock) clear(options, resolved, goes_on);
  const bool of_state = c.analysis.kind == Analysis::Kind::static_ || c.moves();
  post::StateFile::Options state{.path = options.folder / "state.h5",
                                 .resolved_case = resolved,
                                 .version = PDPLATE_VERSION,
                                 .velocities = c.moves(),
                                 .goes_on = goes_on,
                                 .in_plane = of_state && plate::has_plane(c)};
  auto sink = std::make_unique<post::Folder>(
      post::FolderOptions{options.folder, c.output.vtk, c.output.hdf5, std::move(state), options.communicator},
      std::move(lock));
  plate::wait_for_all(all);
  return {{std::move(sink), resolved, PDPLATE_VERSION, post::ProcessesOfRun(all)}, std::move(checkpoints)};
}

}  // namespace cases
