#include "cases/driver/results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cases/input/case_file.hpp"
#include "plate/model/process.hpp"
#include "post/files/digest.hpp"
#include "post/files/earlier.hpp"
#include "post/files/sinks/folder.hpp"
#include "post/files/sinks/kept_sink.hpp"
#include "post/report/say.hpp"

namespace cases {

RunOptions RunOptions::part(const std::string& name) const {
  if (kept) kept->parts[name].wants_fields = kept->wants_fields;
  return {folder / name, quiet, kept ? &kept->parts[name] : nullptr, resume};
}

namespace {

Problem in_use(const std::filesystem::path& folder) {
  return {"--out", folder.string(), "another run writes to this folder: wait for its end, or choose another"};
}

}  // namespace

void check_folder(const std::filesystem::path& folder) {
  constexpr std::size_t most = 3;
  if (!post::FolderLock(folder).held()) throw CaseError({in_use(folder)});
  auto found = post::strangers(folder);
  if (found.empty()) return;
  if (found.size() > most) found.resize(most), found.back() = "...";
  throw CaseError(
      {{"--out", folder.string(),
        fmt::format("holds {}, but no results of a run: choose another folder, or empty it", fmt::join(found, ", "))}});
}

namespace {

/// Of results that stay in memory nothing is kept.
Recording in_memory(post::Kept& kept, const Case& c, std::string resolved) {
  kept.resolved = resolved;
  kept.wants_fields = kept.wants_fields && (c.output.vtk || c.output.hdf5);
  return {{std::make_unique<post::KeptSink>(kept), std::move(resolved), PDPLATE_VERSION}, nullptr};
}

/// Looks for what an earlier run has kept; true where this one goes on from it.
bool finds(fracture::Keeper& keeper, const RunOptions& options) {
  std::vector<std::string> refused;
  const bool found = keeper.find(refused);
  if (!found && !refused.empty()) {
    std::vector<Problem> problems;
    for (const auto& one : refused) problems.push_back({"--resume", options.folder.string(), one});
    throw CaseError(problems);
  }
  for (const auto& one : refused) post::say(one + ": goes on from the one before\n");
  if (!options.quiet)
    post::say(fmt::format("{}: {}\n", options.folder.string(),
                          found ? "goes on from the last checkpoint" : "there is no checkpoint: begins anew"));
  return found;
}

}  // namespace

Recording recording_of(const Case& c, const RunOptions& options) {
  auto resolved = resolved_toml(c);
  if (options.kept) return in_memory(*options.kept, c, std::move(resolved));
  const auto& folder = options.folder;
  std::filesystem::create_directories(folder);
  post::FolderLock lock(folder);
  if (!lock.held()) throw CaseError({in_use(folder)});
  std::unique_ptr<fracture::Keeper> keeper;
  if (c.output.checkpoint_every > 0) {
    const auto of = fmt::format("case {}, program {} of {}", post::digest(resolved), PDPLATE_VERSION, plate::build());
    keeper = std::make_unique<fracture::Keeper>(post::Checkpoints(folder, of), c.output.checkpoint_every);
  }
  const bool goes_on = options.resume && keeper && finds(*keeper, options);
  const auto removed = goes_on ? 0 : post::remove_earlier(folder);
  if (removed > 0 && !options.quiet)
    post::say(fmt::format("{}: removed {} files of an earlier run\n", folder.string(), removed));
  auto sink =
      std::make_unique<post::Folder>(post::FolderOptions{folder, resolved, PDPLATE_VERSION, c.output.vtk, c.output.hdf5,
                                                         c.analysis.kind == Analysis::Kind::dynamic, goes_on},
                                     std::move(lock));
  return {{std::move(sink), std::move(resolved), PDPLATE_VERSION}, std::move(keeper)};
}

fracture::RunPlan plan_of(const Case& c, const RunOptions& options) {
  const auto& output = c.output;
  fracture::RunPlan plan{c,
                         c.analysis,
                         c.growth,
                         c.srif,
                         output.probes,
                         c.title,
                         c.source,
                         c.units,
                         c.formulation_reason,
                         output.every,
                         output.history_every,
                         output.vtk,
                         output.hdf5,
                         {},
                         options.quiet};
  if (!options.kept && output.reports()) plan.report = options.folder;
  return plan;
}

}  // namespace cases
