#include "cases/driver/results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cases/input/case_file.hpp"
#include "post/files/earlier.hpp"
#include "post/files/sinks/folder.hpp"
#include "post/files/sinks/kept_sink.hpp"

namespace cases {

RunOptions RunOptions::part(const std::string& name) const {
  if (kept) kept->parts[name].wants_fields = kept->wants_fields;
  return {folder / name, quiet, kept ? &kept->parts[name] : nullptr};
}

void check_folder(const std::filesystem::path& folder) {
  constexpr std::size_t most = 3;
  auto found = post::strangers(folder);
  if (found.empty()) return;
  if (found.size() > most) found.resize(most), found.back() = "...";
  throw CaseError(
      {{"--out", folder.string(),
        fmt::format("holds {}, but no results of a run: choose another folder, or empty it", fmt::join(found, ", "))}});
}

post::Recorder recorder_of(const Case& c, const RunOptions& options) {
  auto resolved = resolved_toml(c);
  if (options.kept) {
    options.kept->resolved = resolved;
    options.kept->wants_fields = options.kept->wants_fields && (c.output.vtk || c.output.hdf5);
    return {std::make_unique<post::KeptSink>(*options.kept), std::move(resolved), PDPLATE_VERSION};
  }
  const auto& folder = options.folder;
  const auto removed = post::remove_earlier(folder);
  if (removed > 0 && !options.quiet)
    fmt::print(stderr, "{}: removed {} files of an earlier run\n", folder.string(), removed);
  auto sink = std::make_unique<post::Folder>(post::FolderOptions{
      folder, resolved, PDPLATE_VERSION, c.output.vtk, c.output.hdf5, c.analysis.kind == Analysis::Kind::dynamic});
  return {std::move(sink), std::move(resolved), PDPLATE_VERSION};
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
