#include "cases/driver/case_plan.hpp"

#include "cases/input/case_file.hpp"
#include "cases/input/formulations.hpp"
#include "cases/input/keys.hpp"
#include "plate/formulations.hpp"
#include "post/files/sinks.hpp"

namespace cases {

RunOptions RunOptions::part(const std::string& name) const {
  if (in_memory) in_memory->parts[name].wants_fields = in_memory->wants_fields;
  return {folder / name, quiet, in_memory ? &in_memory->parts[name] : nullptr, resume, communicator};
}

RecordingOptions recording_options(const Case& c, const RunOptions& options) {
  const auto& out = c.output;
  const bool moves = c.analysis.kind == Analysis::Kind::dynamic;
  return {options.folder, resolved_toml(c),     PDPLATE_VERSION, out.vtk,       out.hdf5,
          moves,          out.checkpoint_every, options.resume,  options.quiet, options.communicator};
}

Recording recording_of(const Case& c, const RunOptions& options) {
  if (!options.in_memory) return recording(recording_options(c, options));
  auto& in_memory = *options.in_memory;
  in_memory.resolved = resolved_toml(c);
  in_memory.wants_fields = in_memory.wants_fields && (c.output.vtk || c.output.hdf5);
  return {{std::make_unique<post::MemorySink>(in_memory), in_memory.resolved, PDPLATE_VERSION}, nullptr};
}

RunPlan plan_of(const Case& c, const RunOptions& options) {
  const auto& [vtk, hdf5, reports, every, history_every, checkpoint_every, probes] = c.output;
  const auto report = options.in_memory || !c.output.reports() ? std::nullopt : std::optional(options.folder);
  return {c,     c.analysis,    c.growth, c.srif, probes, c.title,      c.source, c.units, c.formulation_reason,
          every, history_every, vtk,      hdf5,   report, options.quiet};
}

CaseFile in_other_formulation(const CaseFile& file) {
  CaseFile result = file;
  Case& c = result.content;
  const auto given = c.discretization;
  c.discretization = {};
  c.discretization.spacing = given.spacing;
  c.discretization.formulation = &plate::other_formulation(*given.formulation);
  c.formulation_reason = "the other one of srif.second_formulation";
  c.analysis.preconditioner = plate::Preconditioning::automatic;
  c.analysis.precision = Analysis::Precision::double_;
  if (c.analysis.method == Analysis::Method::lanczos) c.analysis.method = Analysis::Method::central_difference;
  c.output.vtk = c.output.hdf5 = false;
  c.srif->second_formulation = c.srif->richardson = false;

  Reading reading("");
  reading.found().places = file.source.places;
  reading.kind = c.analysis.kind;
  resolve_grading(c, reading);
  check_case(c, reading);
  auto problems = reading.problems();
  for (auto& problem : problems) problem.what = "srif.second_formulation: " + problem.what;
  if (!problems.empty()) throw CaseError(problems);
  return result;
}

}  // namespace cases
