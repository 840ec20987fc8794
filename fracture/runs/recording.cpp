#include "fracture/runs/recording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fracture/runs/shared/among_ranks.hpp"
#include "plate/model/process.hpp"
#include "plate/model/ranks/ranks.hpp"
#include "post/files/digest.hpp"
#include "post/files/earlier.hpp"
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

/// Where processes share the plate: when the first has made the folder ready, all write their pieces into it.
std::unique_ptr<post::Sink> of_pieces(const RecordingOptions& options, std::unique_ptr<post::Sink> rest) {
  std::array<std::int64_t, 1> ready{1};
  plate::ranks()->sum(ready);
  return std::make_unique<post::Pieces>(*plate::ranks(), options.folder, options.vtk, std::move(rest));
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
  if (!speaks()) return {{of_pieces(options, nullptr), options.resolved, options.version}, nullptr};
  const auto& [folder, resolved, version, vtk, hdf5, velocities, every, resumes, quiet] = options;
  std::filesystem::create_directories(folder);
  post::FolderLock lock(folder);
  require_lock(lock);
  std::unique_ptr<Keeper> keeper;
  if (every > 0 && !plate::ranks()) {
    const auto of = fmt::format("case {}, program {} of {}", post::digest(resolved), version, plate::build());
    keeper = std::make_unique<Keeper>(post::Checkpoints(folder, of), every);
  }
  const bool goes_on = resumes && finds(keeper.get(), options);
  const bool same = resumes && post::is_of(folder, resolved);  // then runs that belong to it may go on
  const auto removed = goes_on ? 0 : post::remove_earlier(folder, same ? post::Parts::stay : post::Parts::go);
  if (removed > 0 && !quiet)
    post::say(fmt::format("{}: removed {} files of an earlier run\n", folder.string(), removed));
  auto sink = std::make_unique<post::Folder>(
      post::FolderOptions{folder, resolved, version, vtk, hdf5, velocities, goes_on}, std::move(lock));
  if (shared()) return {{of_pieces(options, std::move(sink)), resolved, version}, nullptr};
  return {{std::move(sink), resolved, version}, std::move(keeper)};
}

}  // namespace fracture
