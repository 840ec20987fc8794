#include "fracture/runs/faults/lacking.hpp"

#include <fmt/format.h>

#include "fracture/runs/run_plan.hpp"
#include "post/studies/quantity.hpp"

namespace fracture {
namespace {

/// Of the whole plate.
std::string lacking_whole(const RunPlan& plan, const std::string& name) {
  const bool modes = plan.analysis.kind == plate::Analysis::Kind::frequencies;
  if (name == "frequency") return modes ? "" : "the case has no frequencies";
  if (!plan.problem.load_cases.empty()) return "the case has load cases: envelope.csv and srif.csv have their factors";
  if (modes) return "the case has frequencies only";
  if (plan.analysis.kind == plate::Analysis::Kind::harmonic)
    return "the case has a response over frequencies: response.csv has it";
  if (name.ends_with("_peak") && (!plan.moves() || plan.growth))
    return "peaks in time are of dynamic cases without growth";
  if (name == "crack_length" && !plan.growth) return "the case has no [growth]";
  if (name == "largest_load_factor" && !plan.grows_at_rest()) return "the case has no quasi-static growth";
  return "";
}

}  // namespace

std::string lacking(const RunPlan& plan, const post::Quantity& quantity) {
  if (auto why = lacking_whole(plan, quantity.name); !why.empty()) return why;
  if (quantity.probe && !plan.probes.contains(*quantity.probe))
    return fmt::format("the case has no probe \"{}\"", *quantity.probe);
  if (!quantity.tip) return "";
  if (!plan.srif) return "the case has no [srif]";
  if (quantity.name.starts_with('F') && !plan.srif->normalize) return "the case has no srif.normalize";
  const auto tips = geometry::tips(plate::crack_paths(plan.problem)).size();
  return *quantity.tip < tips ? "" : fmt::format("the case has {} crack tips, counted from 0", tips);
}

}  // namespace fracture
