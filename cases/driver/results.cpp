#include "cases/driver/results.hpp"
#include "cases/input/case_file.hpp"
#include "post/files/sinks/kept_sink.hpp"

namespace cases {

RunOptions RunOptions::part(const std::string& name) const {
  if (kept) kept->parts[name].wants_fields = kept->wants_fields;
  return {folder / name, quiet, kept ? &kept->parts[name] : nullptr, resume};
}

fracture::RecordingOptions recording_options(const Case& c, const RunOptions& options) {
  const auto& out = c.output;
  const bool moves = c.analysis.kind == Analysis::Kind::dynamic;
  return {options.folder, resolved_toml(c),     PDPLATE_VERSION, out.vtk,      out.hdf5,
          moves,          out.checkpoint_every, options.resume,  options.quiet};
}

fracture::Recording recording_of(const Case& c, const RunOptions& options) {
  if (!options.kept) return fracture::recording(recording_options(c, options));
  auto& kept = *options.kept;
  kept.resolved = resolved_toml(c);
  kept.wants_fields = kept.wants_fields && (c.output.vtk || c.output.hdf5);
  return {{std::make_unique<post::KeptSink>(kept), kept.resolved, PDPLATE_VERSION}, nullptr};
}

fracture::RunPlan plan_of(const Case& c, const RunOptions& options) {
  const auto& [vtk, hdf5, reports, every, history_every, checkpoint_every, probes] = c.output;
  const auto report = options.kept || !c.output.reports() ? std::nullopt : std::optional(options.folder);
  return {c,     c.analysis,    c.growth, c.srif, probes, c.title,      c.source, c.units, c.formulation_reason,
          every, history_every, vtk,      hdf5,   report, options.quiet};
}

}  // namespace cases
