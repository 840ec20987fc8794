#include "cases/driver/prepared.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "cases/input/case_file.hpp"
#include "cases/runs/bonds_error.hpp"
#include "cases/runs/distributed_run.hpp"
#include "cases/runs/run_plan.hpp"
#include "fracture/growth/growth.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/formulation/mechanisms.hpp"
#include "plate/model/membrane.hpp"
#include "plate/model/support_validation.hpp"
#include "plate/solve/motion/initial_conditions.hpp"
#include "plate/solve/motion/stretched_motion.hpp"
#include "plate/solve/motion/time_grid.hpp"
#include "plate/solve/validation.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/report/probes_and_lines.hpp"

namespace cases {
namespace {

/// Probes, lines and places of impacts that have no points about them.
void check_places(const CaseFile& file, const plate::Formulation& plate, std::vector<Problem>& problems) {
  const auto check = [&](const std::string& key, const geometry::Point& x) {
    try {
      if (plate.here(x)) plate.interpolation(x);
    } catch (const plate::Refused& error) {
      problems.push_back({file.place(key), key, error.what()});
    }
  };
  for (const auto& [name, x] : file.content.output.probes) check("output.probes." + name, x);
  for (const auto& [name, ends] : file.content.output.lines) try {
      if (post::sampled_line(name, ends[0], ends[1], plate).places.empty())
        problems.push_back({file.place("output.lines." + name), "output.lines." + name, "does not meet the plate"});
    } catch (const plate::Refused& error) {
      problems.push_back({file.place("output.lines." + name), "output.lines." + name, error.what()});
    }
  if (file.content.impact) check("impact.position", file.content.impact->position);
}

/// One process pins every part that no support holds in the plane of a plate with large deflections or of a coupled
/// one; several pin a plate of one part alone.
void check_held_in_plane(const CaseFile& file, const plate::Discretised& plates, std::vector<Problem>& problems) {
  const Case& c = file.content;
  const bool couples_at_first = c.coupled() && (!c.moves() || c.analysis.start == Analysis::Start::equilibrium ||
                                                (c.initial && c.initial->deflection.given()));
  if ((c.stretches_at_first() || couples_at_first) && plates.plate->distributed() && !plates.membrane->held() &&
      plates.membrane->pieces().size() > 1)
    problems.push_back(
        {file.place("support"), "support",
         "does not hold all parts of the plate in its plane, which several processes need for large deflections and "
         "for sections that couple bending and stretching: set in_plane, or run it by one (pdplate)"});
}

}  // namespace

void require_distributable(const CaseFile& file, int processes) {
  std::vector<Problem> problems;
  for (const auto& [key, what] : errors_in_distribution(file.content, processes))
    problems.push_back({file.place(key), key, what});
  if (!problems.empty()) throw CaseError(problems);
}

plate::Discretised discretised(const CaseFile& file, const plate::Communicator& communicator) {
  const Case& c = file.content;
  auto result = unless_refused(file, [&] { return plate::discretise(c, communicator); });
  const auto& plate = *result.plate;
  const auto suits = plate::validate(plate, c.analysis);
  auto problems = problems_of(file, suits.refusals);
  const bool may_fly = c.moves() && c.analysis.start == Analysis::Start::undeformed;
  // pins would bear what contact presses
  const bool parted = c.faces_touch() && result.membrane && result.membrane->pieces().size() > 1;
  if (!may_fly && (parted || (result.membrane &&
                              (plate::loaded_in_plane(c) || c.analysis.kind == plate::Analysis::Kind::harmonic))))
    for (auto& problem : problems_of(file, plate::loose(*result.membrane))) problems.push_back(std::move(problem));
  check_places(file, plate, problems);
  check_held_in_plane(file, result, problems);
  if (!problems.empty()) throw CaseError(problems);
  auto& warnings = result.warnings;
  warnings.insert(warnings.begin(), file.source.notes.begin(), file.source.notes.end());
  for (const auto& some : {suits.warnings, plate.warnings(c.srif.has_value()),
                           plate::warnings_about_rotary_inertia(plate, c.analysis.rotary_inertia),
                           c.growth ? fracture::warnings_about_bonds(*c.growth, plate) : std::vector<std::string>(),
                           plate::warnings_about_mechanisms(plate), plate::warnings_about_held_holes(c),
                           plate::warnings_about_hubs(c), plate::warnings_about_axial_stiffness(c)})
    warnings.insert(warnings.end(), some.begin(), some.end());
  if (c.analysis.kind == Analysis::Kind::frequencies)  // which have no stress
    std::erase_if(warnings, [](const std::string& line) { return line.starts_with("stress of bonds"); });
  return result;
}

void check_growing_tips(const CaseFile& file, const plate::Formulation& plate, std::vector<std::string>& warnings) {
  const Case& c = file.content;
  if (!c.growth || c.growth->by_bonds()) return;
  std::vector<Problem> problems;
  for (const auto& why : fracture::tips_without_rings(plate))
    if (c.analysis.kind == Analysis::Kind::dynamic)
      warnings.push_back(why + " (it stays where it is)");
    else
      problems.push_back({file.place("growth"), "growth", why});
  if (!problems.empty()) throw CaseError(problems);
}

std::vector<post::TipMethods> tip_methods(const CaseFile& file, const plate::Formulation& plate) {
  if (!file.content.srif) return {};
  auto result = post::tip_methods(plate, *file.content.srif);
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const auto& x = plate.tips()[i].position;
    if (!result[i].works())
      problems.push_back({file.place("srif"), "srif",
                          fmt::format("tip at ({:g}, {:g}): {}", x.x(), x.y(), result[i].left_out().front())});
  }
  if (!problems.empty() && problems.size() == result.size()) throw CaseError(problems);
  return result;
}

namespace {

constexpr std::size_t many_steps = 100000;

/// Warnings of loads that move so fast that steps miss points.
std::vector<std::string> warnings_about_speeds(const Case& c, double time_step) {
  std::vector<std::string> result;
  const double fastest = c.discretization.spacing / time_step;
  for (std::size_t i = 0; i < c.loads.size(); ++i)
    if (const auto& load = c.loads[i]; load.moves() && load.speed() > fastest)
      result.push_back(
          fmt::format("{} moves {:.2g} spacings per time step, so that steps miss points; set {}.speed = "
                      "{:.2g} or less",
                      key_of_load(c, i), load.speed() / fastest, key_of_load(c, i), fastest));
  return result;
}

/// Lanczos vectors need static answers: a plate that moves freely takes steps, unless its case states the vectors.
void resolve_free_motion(CaseFile& file, const plate::Formulation& plate) {
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

Prepared::Prepared(CaseFile wanted, const plate::Communicator& communicator) : file(std::move(wanted)) {
  auto found = discretised(file, communicator);
  plate = std::move(found.plate), membrane = std::move(found.membrane), warnings = std::move(found.warnings),
  stopwatch = found.stopwatch;
  const Case& c = file.content;
  if (c.analysis.kind == Analysis::Kind::dynamic) {
    begin = begin_of(file, *plate);
    check_growing_tips(file, *plate, warnings);
    if (c.analysis.method == Analysis::Method::lanczos) resolve_free_motion(file, *plate);
    if (c.analysis.method == Analysis::Method::lanczos) {
      steps = {0, unless_refused(file, [&] { return plate::row_grid(grid_options(c)); })};
    } else {
      const double rotary = c.analysis.rotary_inertia;
      const double free =
          membrane ? plate::stable_time_step(*plate, *membrane, rotary) : plate::stable_time_step(*plate, rotary);
      const auto [limit, relaxation] = plate::damped_step(free, *plate, c.analysis, begin);
      steps = {limit, time_grid(file, limit)};
      steps->grid.relaxation = relaxation;
      std::ranges::move(warnings_about_speeds(c, steps->grid.time_step), std::back_inserter(warnings));
      if (relaxation > 0)
        warnings.push_back(fmt::format(
            "damping by the stiffness is exact to 1 % below the frequency {:.3g} only; set analysis.time_step = {:.3g}",
            plate::exact_below(*c.analysis.damping), plate::stable_step(free, *plate, c.analysis, begin)));
      if (limit < 0.2 * free && steps->grid.steps > many_steps)
        warnings.push_back(fmt::format(
            "{} steps: damping, an impact or a given motion shortens the stable step from {:.2g} to {:.2g}; set {}",
            steps->grid.steps, free, limit,
            c.growth ? "a larger discretization.spacing" : "formulation = \"galerkin\""));
    }
    stopwatch.lap("solve");
  }
  const bool sways = c.analysis.kind == Analysis::Kind::frequencies;  // its first frequency is compared by the run
  if (!sways && (c.analysis.kind != Analysis::Kind::static_ || !c.load_cases.empty())) {
    const auto remedy = c.growth ? fmt::format("set discretization.spacing = {:.2g}", c.discretization.spacing / 2)
                                 : std::string("set formulation = \"galerkin\"");
    compare_under_pressure(*plate, c, warnings, remedy), stopwatch.lap("second_formulation");
  }
  tip_methods = cases::tip_methods(file, *plate);
  if (membrane) membrane_methods = cases::tip_methods(file, *membrane);
  for (auto& one : post::warnings_about_ligaments(*plate)) warnings.push_back(std::move(one));
  stopwatch.lap("srif");
}

plate::TimeGrid time_grid(const CaseFile& file, double limit) {
  return unless_refused(file, [&] { return plate::time_grid(grid_options(file.content), limit); });
}

}  // namespace cases
