#include "cases/driver/prepared.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/driver/discretised.hpp"
#include "cases/driver/results.hpp"
#include "cases/input/refused.hpp"
#include "fracture/runs/bonds_error.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/solve/motion/begin.hpp"
#include "post/factors/plate_factors.hpp"

namespace cases {
namespace {

constexpr std::size_t many_steps = 100000;

/// Lanczos vectors need static answers: a plate that moves freely takes steps, unless its case states the vectors.
void settle_free_motion(CaseFile& file, const plate::Formulation& plate) {
  if (!plate.may_move() && plate.held()) return;
  if (file.content.srif && file.content.srif->accuracy)
    throw CaseError({{file.place("srif.accuracy"), "srif.accuracy",
                      "in motion needs a plate that supports hold: hold it, or state the discretisation instead"}});
  const bool stated =
      std::ranges::any_of(file.source.places, [](const auto& given) { return given.first == "analysis.method"; });
  if (stated)
    throw CaseError({{file.place("analysis.method"), "analysis.method",
                      "\"lanczos\" needs a plate that supports hold; choose \"central_difference\""}});
  file.content.analysis.method = Analysis::Method::central_difference;
}

plate::BeginOfMotion begin_of(const CaseFile& file, const plate::Formulation& plate) {
  const auto refused = [&](const auto& error) {
    const bool bent = file.content.initial->deflection.text() == error.formula();
    const std::string key = bent ? "initial.deflection" : "initial.velocity";
    return CaseError({{file.place(key), key, error.what()}});
  };
  try {
    return plate::begin_of_motion(plate, file.content.analysis.rotary_inertia);
  } catch (const plate::FormulaError& error) {
    throw refused(error);
  } catch (const plate::Jumps& error) {
    throw refused(error);
  }
}

}  // namespace

Prepared::Prepared(CaseFile wanted) : file(std::move(wanted)) {
  auto found = discretised(file);
  plate = std::move(found.plate), warnings = std::move(found.warnings), stopwatch = found.stopwatch;
  const Case& c = file.content;
  if (c.analysis.kind == Analysis::Kind::dynamic) {
    begin = begin_of(file, *plate);
    check_growing_tips(file, *plate, warnings);
    if (c.analysis.method == Analysis::Method::lanczos) settle_free_motion(file, *plate);
    if (c.analysis.method == Analysis::Method::lanczos) {
      steps = {0, unless_refused(file, [&] { return plate::row_grid(fracture::grid_options(plan_of(c, {}))); })};
    } else {
      const double free = plate::stable_time_step(*plate, c.analysis.rotary_inertia);
      const double limit = plate::stable_step(free, *plate, c.analysis, begin);
      steps = {limit, time_grid(file, limit)};
      if (limit < 0.2 * free && steps->grid.steps > many_steps)
        warnings.push_back(
            fmt::format("{} steps: damping, an impact or given motion shortens the stable step from {:.2g} to {:.2g}; "
                        "damping by mass alone does not, and with formulation = \"galerkin\" linear plates take no "
                        "steps (method = \"lanczos\")",
                        steps->grid.steps, free, limit));
    }
    stopwatch.lap("solve");
  }
  if (c.analysis.kind != Analysis::Kind::static_ || !c.load_cases.empty())
    fracture::compare_under_pressure(*plate, c, warnings), stopwatch.lap("second_formulation");
  tip_methods = cases::tip_methods(file, *plate);
  for (auto& one : post::distrust_of_ligaments(*plate)) warnings.push_back(std::move(one));
  stopwatch.lap("srif");
}

plate::TimeGrid time_grid(const CaseFile& file, double limit) {
  const auto options = fracture::grid_options(plan_of(file.content, {}));
  return unless_refused(file, [&] { return plate::time_grid(options, limit); });
}

}  // namespace cases
