#include "cases/driver/results.hpp"

#include "cases/input/case_file.hpp"
#include "post/files/sinks/kept_sink.hpp"

namespace cases {

RunOptions RunOptions::part(const std::string& name) const {
  if (kept) kept->parts[name].wants_fields = kept->wants_fields;
  return {folder / name, quiet, kept ? &kept->parts[name] : nullptr, resume};
}

fracture::Recording recording_of(const Case& c, const RunOptions& options) {
  auto resolved = resolved_toml(c);
  const auto& output = c.output;
  if (!options.kept)
    return fracture::recording({options.folder, std::move(resolved), PDPLATE_VERSION, output.vtk, output.hdf5,
                                c.analysis.kind == Analysis::Kind::dynamic, output.checkpoint_every, options.resume,
                                options.quiet});
  auto& kept = *options.kept;
  kept.resolved = resolved;
  kept.wants_fields = kept.wants_fields && (output.vtk || output.hdf5);
  return {{std::make_unique<post::KeptSink>(kept), std::move(resolved), PDPLATE_VERSION}, nullptr};
}

fracture::RunPlan plan_of(const Case& c, const RunOptions& options) {
  const auto& [vtk, hdf5, report, every, history_every, checkpoint_every, probes] = c.output;
  std::optional<std::filesystem::path> folder_of_report;
  if (!options.kept && c.output.reports()) folder_of_report = options.folder;
  return {
      c,     c.analysis,    c.growth, c.srif, probes,           c.title,      c.source, c.units, c.formulation_reason,
      every, history_every, vtk,      hdf5,   folder_of_report, options.quiet};
}

}  // namespace cases
