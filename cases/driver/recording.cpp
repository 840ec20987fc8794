#include "cases/driver/recording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cmath>
#include <sstream>

#include "cases/input/case_file.hpp"
#include "cases/input/toml_reader.hpp"
#include "plate/model/membrane.hpp"
#include "plate/model/process.hpp"
#include "plate/model/reduction.hpp"
#include "plate/solve/motion/time_grid.hpp"
#include "post/files/checkpoints.hpp"
#include "post/files/run_folder.hpp"
#include "post/files/sinks.hpp"
#include "post/files/summary.hpp"
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

/// The case without what a longer motion may change: its duration, on which rows depend where they are not given.
Case without_duration(Case c) {
  if (!c.moves()) return c;
  c.output.history_every = plate::row_of(grid_options(c));
  c.analysis.duration = 1;
  return c;
}

std::unique_ptr<RunCheckpoints> checkpoints_of(const RunPlan& plan) {
  const double every = plan.content.output.checkpoint_every;
  if (every <= 0) return nullptr;
  const auto& all = *plan.options.communicator;
  // of the runs that may continue from one: the same case by the same build of the program
  const auto run =
      fmt::format("case {}, program {} of {}, {}", post::digest(resolved_toml(without_duration(plan.content))),
                  PDPLATE_VERSION, plate::build(), all.distributed() ? "several processes" : "one process");
  return std::make_unique<RunCheckpoints>(post::Checkpoints(all, plan.options.folder, run), every);
}

/// First key that differs between two nodes of cases; nothing where they are equal.
std::optional<std::string> differing_key(const toml::node* one, const toml::node* other, const std::string& key) {
  if (!one || !other) return key;
  if (const auto* a = one->as_table(), *b = other->as_table(); a && b) {
    const auto below = [&](const toml::key& name) {
      const std::string path = key.empty() ? std::string(name.str()) : fmt::format("{}.{}", key, name.str());
      return differing_key(a->get(name.str()), b->get(name.str()), path);
    };
    for (const auto* table : {a, b})
      for (const auto& [name, node] : *table)
        if (auto found = below(name)) return found;
    return std::nullopt;
  }
  const auto *a = one->as_array(), *b = other->as_array();
  for (std::size_t i = 0; a && b && i < std::max(a->size(), b->size()); ++i)
    if (auto found = differing_key(a->get(i), b->get(i), fmt::format("{}[{}]", key, i))) return found;
  if (a && b) return std::nullopt;
  std::ostringstream texts[2];
  texts[0] << toml::node_view(one), texts[1] << toml::node_view(other);
  return texts[0].str() == texts[1].str() ? std::nullopt : std::optional(key);
}

/// A motion in the folder that a run is to go on with: its duration, and its rows where they were given.
struct EarlierMotion {
  double duration;
  std::optional<double> rows;

  EarlierMotion(const toml::table& earlier, const Case& c)
      : duration(earlier["analysis"]["duration"].value_or(c.analysis.duration)),
        rows(earlier["output"]["history_every"].value<double>()) {}
  /// The case with the duration and the rows of this motion.
  Case of(Case c) const {
    c.analysis.duration = duration, c.output.history_every = rows;
    return c;
  }
};

/// Key of the first setting that differs but for the duration; nothing where there is none. Rows that are not given are
/// as far apart as the duration makes them.
std::optional<std::string> changed_key(toml::table earlier, const Case& c) {
  auto now = parsed_text(resolved_toml(c), "");
  if (c.moves()) {
    if (!earlier["analysis"].is_table() || !earlier["output"].is_table()) return "analysis";
    const EarlierMotion before(earlier, c);
    if (plate::row_of(grid_options(before.of(c))) != plate::row_of(grid_options(c))) return "output.history_every";
    auto &old_analysis = *earlier["analysis"].as_table(), &analysis = *now["analysis"].as_table();
    for (auto* one : {&earlier, &now})
      (*one)["analysis"].as_table()->erase("duration"), (*one)["output"].as_table()->erase("history_every");
    // "lanczos" that nobody states may have become time steps
    if (c.analysis.method == Analysis::Method::lanczos && old_analysis["method"] == "central_difference")
      analysis.insert_or_assign("method", "central_difference");
  }
  return differing_key(&earlier, &now, "");
}

/// Throws CaseError where steps or damping would not be those of the earlier motion, which goes on as this one.
void require_same_steps(const CaseFile& file, const Case& earlier) {
  const auto &now = file.content.analysis, &before = earlier.analysis;
  const auto refuse = [&](const std::string& what) {
    throw CaseError({{file.place("analysis.duration"), "analysis.duration", what}});
  };
  if (now.duration < before.duration)
    refuse(fmt::format("is shorter than {:g}, that of the run which --resume goes on with", before.duration));
  if (now.time_step) return;
  const auto relaxes = [&](double duration) { return plate::exact_below(*now.damping) * duration >= 1; };
  if (now.damping && now.damping->stiffness > 0 && relaxes(before.duration) != relaxes(now.duration))
    refuse("of so much longer takes other steps with damping by the stiffness: run it without --resume");
  const double row = plate::row_grid(grid_options(earlier)).time_step;
  if (row == plate::row_grid(grid_options(file.content)).time_step) return;
  if (row != plate::row_of(grid_options(earlier)))
    refuse(
        fmt::format("cannot change: output.history_every is no part of {:g}, that of the run which --resume goes on "
                    "with; run it without --resume",
                    before.duration));
  refuse(
      fmt::format("must be a multiple of the time {:g} between rows of the run which --resume goes on with: set {:g}",
                  row, std::ceil(now.duration / row) * row));
}

}  // namespace

CaseFile going_on(const CaseFile& file, const RunOptions& options) {
  const auto path = options.folder / "case.resolved.toml";
  std::error_code none;
  if (!options.resume || options.in_memory || !std::filesystem::exists(path, none)) return file;
  const auto earlier = parsed(path, "run");
  CaseFile result = file;
  Case& c = result.content;
  const EarlierMotion before(earlier, c);
  if (c.moves() && !c.output.history_every && (before.rows || before.duration != c.analysis.duration))
    c.output.history_every = plate::row_of(grid_options(before.of(c)));
  const auto changed = changed_key(earlier, c);
  const post::Checkpoints checkpoints(*options.communicator, options.folder, "");
  if (!checkpoints.any() && !checkpoints.kept()) {
    const auto summary = post::read_summary(options.folder / "summary.json");
    if (!changed && c.moves() && c.analysis.duration != before.duration && summary && summary->outcome == "done")
      throw CaseError(
          {{file.place("analysis.duration"), "analysis.duration",
            fmt::format("is {:g} in the run which --resume is to go on with, and that has no checkpoint, as "
                        "method = \"lanczos\" or output.checkpoint_every = 0 leave none: run it without "
                        "--resume",
                        before.duration)}});
    return file;
  }
  if (changed)
    throw CaseError({{file.place(*changed), *changed,
                      fmt::format("differs in {}, which --resume is to go on with: only analysis.duration may change, "
                                  "to be longer; run it without --resume",
                                  path.string())}});
  if (c.moves()) require_same_steps(result, before.of(c));
  return result;
}

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
  auto checkpoints = checkpoints_of(plan);
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
