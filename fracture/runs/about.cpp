#include <fmt/format.h>

#include "fracture/runs/results.hpp"
#include "fracture/runs/shared/among_ranks.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/numerical_error.hpp"
#include "plate/solve/interruption.hpp"
#include "post/report/html/report.hpp"
#include "post/report/scene.hpp"

namespace fracture {

std::vector<post::Probe> probes_of(const std::map<std::string, geometry::Point>& places,
                                   const plate::Formulation& plate) {
  std::vector<post::Probe> result;
  for (const auto& [name, x] : places)
    result.push_back({name, x, plate.here(x) ? plate.interpolation(x) : std::vector<plate::PlaceShare>{}});
  return result;
}

post::Summary about(const RunPlan& plan, const plate::Formulation& plate, std::vector<std::string> warnings) {
  auto summary = post::about(plate, plan.analysis, {plan.srif.has_value(), plan.fields});
  summary.title = plan.title;
  summary.units = plan.units;
  summary.formulation_reason = plan.formulation_reason;
  summary.warnings = std::move(warnings);
  count_all(summary, plate);
  return summary;
}

plate::NumericalError placed(const plate::NumericalError& error, const plate::Formulation& plate,
                             const post::Summary& summary) {
  std::string said = error.what();
  if (const auto& places = plate.cloud().positions; error.point && *error.point < places.size())
    said += fmt::format("; the point is at ({:g}, {:g})", places[*error.point].x(), places[*error.point].y());
  if (const auto& analysis = summary.analysis; analysis.time_step && analysis.time_step_limit)
    said += fmt::format("; the time step {:g} is {:.3g} of the stable one", *analysis.time_step,
                        *analysis.time_step / *analysis.time_step_limit);
  return plate::NumericalError(said);
}

post::Summary carried_out(post::Summary summary, const plate::Formulation& plate,
                          const std::function<void(post::Summary&)>& solve,
                          const std::function<post::Summary(post::Summary)>& finish) {
  const plate::StopOnSignals signals;
  try {
    solve(summary);
    summary.outcome = "done";
  } catch (const plate::NumericalError& error) {
    const auto failed = placed(error, plate, summary);
    summary.outcome = fmt::format("failed: {}", failed.what());
    summary.analysis.stop_reason = failed.what();
    finish(summary);
    throw failed;
  } catch (const plate::Interrupted& asked) {
    summary.outcome = "interrupted";
    summary.analysis.stop_reason = asked.what();
    finish(summary);
    throw;
  }
  return finish(std::move(summary));
}

void write_report(const RunPlan& plan, const post::Pictures& pictures) {
  if (plan.report && speaks())
    post::write_report(*plan.report, {plan.problem, plan.title, plan.source, plan.units, plan.probes}, pictures);
}

}  // namespace fracture
