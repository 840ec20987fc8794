#include "cases/runs/outputs.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "cases/input/problems.hpp"
#include "cases/runs/analyses.hpp"
#include "cases/runs/distributed_run.hpp"
#include "cases/runs/owned_mesh.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/archive.hpp"
#include "plate/solve/interruption.hpp"
#include "post/report/cost_model.hpp"
#include "post/report/errors_of_results.hpp"
#include "post/report/html_report.hpp"
#include "post/report/probes_and_lines.hpp"
#include "post/report/singular_places.hpp"

namespace cases {

post::ReportedCase reported(const Case& c) {
  return {.problem = c,
          .title = c.title,
          .source = c.source,
          .units = c.units,
          .project = c.project,
          .author = c.author,
          .date = c.date,
          .probes = c.output.probes};
}

post::Summary about(const Case& c, const plate::Formulation& plate, std::vector<std::string> warnings) {
  auto summary = post::about(plate, c.analysis, {c.srif.has_value(), c.output.vtk});
  summary.title = c.title;
  summary.units = c.units;
  summary.formulation_reason = c.formulation_reason;
  summary.recipe = c.recipe_keys;
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

std::vector<post::Probe> probes_of(const std::map<std::string, geometry::Point>& places,
                                   const plate::Formulation& plate) {
  std::vector<post::Probe> result;
  for (const auto& [name, x] : places)
    result.push_back({name, x, plate.here(x) ? plate.interpolation(x) : std::vector<plate::PlaceShare>{}});
  return result;
}

Outputs::Outputs(const RunPlan& plan, post::Recorder recorder, plate::Stopwatch& stopwatch)
    : plan_(plan), recorder_(std::move(recorder)), stopwatch_(stopwatch), factors_(plan.content.section.thickness) {}

Outputs::~Outputs() = default;

void Outputs::warn(std::vector<std::string> warnings) {
  std::ranges::move(warnings, std::back_inserter(summary_.warnings));
}

void Outputs::place_probes(const plate::Formulation& plate) {
  probes_ = probes_of(content().output.probes, plate);
  if (content().ties_faces()) springs_ = std::make_unique<post::SpringsOnCracks>(plate);
  around_.reset();
  if (content().analysis.kind == Analysis::Kind::static_ && !content().growth && !plate.distributed())
    around_ = std::make_unique<post::StressAround>(
        plate, content().output.stress_distance.value_or(content().section.thickness));
  if (around_ && around_->none()) around_.reset();
  lines_.clear();
  for (const auto& [name, ends] : content().output.lines)
    lines_.push_back(post::sampled_line(name, ends[0], ends[1], plate));
}

void Outputs::open(const plate::Formulation& plate) {
  place_probes(plate);
  if (!recorder_.draws() && !recorder_.stores()) return;
  const auto mesh = recorder_.draws() || plan_.reports() ? plate.mesh() : post::points_of(plate);
  drawing_ = owned_mesh(plate, mesh);
  if (!drawing_ && plan_.reports()) pictures_.open(mesh);
  recorder_.open(drawing_ ? drawing_->mesh() : mesh);
}

void Outputs::row(const post::Sample& sample, const plate::Formulation& plate) {
  recorder_.row(sample, probes_, plate.boundary());
}

void Outputs::frame(const plate::Formulation& plate, post::Frame frame, std::optional<plate::Mesh> mesh,
                    const plate::State& velocity, bool governs) {
  if (takes_values()) take_values(plate, frame);
  if (!recorder_.draws() && !recorder_.stores()) return;
  if (mesh) drawing_ = owned_mesh(plate, *mesh);
  if (drawing_) {
    if (mesh) mesh = drawing_->mesh();
    recorder_.frame(drawing_->frame(std::move(frame)), std::move(mesh),
                    velocity.cols() > 0 ? drawing_->own(velocity) : velocity);
    return;
  }
  if (plan_.reports()) {
    if (mesh) pictures_.open(*mesh);
    pictures_.look(frame, governs);
  }
  recorder_.frame(std::move(frame), std::move(mesh),
                  velocity.cols() > 0 ? velocity.leftCols(Eigen::Index(plate.cloud().plate_points)) : velocity);
}

void Outputs::final_state(const plate::Formulation& plate, post::Frame frame) {
  const auto mesh = post::points_of(plate);
  if (const auto own = owned_mesh(plate, mesh)) return recorder_.final_state(own->mesh(), own->frame(std::move(frame)));
  recorder_.final_state(mesh, frame);
}

void Outputs::given_cracks(const plate::Formulation& plate, const std::vector<post::Srif>& factors) {
  if (const auto cracks = post::given_cracks(plate.paths()); !cracks.lines.empty()) recorder_.cracks(cracks, factors);
}

void Outputs::save(plate::OutArchive& archive) {
  recorder_.save(archive);
  archive(pictures_);
}

void Outputs::restore(plate::InArchive& archive) {
  recorder_.restore(archive);
  archive(pictures_);
}

namespace {

/// Puts keys in the place of the settings that messages of the folders below name.
void name_settings_by_keys(post::Summary& summary) {
  const auto name = [](std::string& message) { message = with_keys(message); };
  std::ranges::for_each(summary.warnings, name);
  name(summary.outcome), name(summary.analysis.stop_reason);
  if (summary.growth) name(summary.growth->outcome);
  if (summary.accuracy) name(summary.accuracy->ended_by);
  if (summary.targets) name(summary.targets->ended_by);
}

}  // namespace

bool Outputs::takes_values() const {
  const bool wanted = !probes_.empty() || !lines_.empty() || springs_ || around_;
  return wanted && content().analysis.kind == Analysis::Kind::static_ && !content().growth;
}

void Outputs::take_values(const plate::Formulation& plate, const post::Frame& frame) {
  auto probes = probes_;
  for (auto& probe : probes)
    if (!probe.shares.empty()) probe.shares = post::place_in_frames(plate, probe.position);
  values_.push_back(post::values_at(probes, frame, plate));
  stress_near_.push_back(around_ ? around_->take(frame) : std::vector<post::StressAtDistance>{});
  auto& sums = sums_.emplace_back();
  for (const auto& line : lines_) {
    const auto values = post::values_at(line.places, frame, plate);
    post::add_rows(line_rows_, frame.time, line, values);
    auto own = post::sums_along(line, values);
    // membrane forces along the deflected plate carry across it too
    if (content().analysis.nonlinear) std::erase_if(own, [](const auto& one) { return one.quantity == "shear"; });
    std::ranges::move(own, std::back_inserter(sums));
  }
  if (springs_) std::ranges::move(springs_->take(frame, spring_rows_), std::back_inserter(sums));
}

/// Gives the summary the values at probes, and errors to all.
void Outputs::set_errors() {
  if (!values_.empty() && summary_.load_cases.empty())
    summary_.probes = values_.back(), summary_.lines = sums_.back(), summary_.stress_near = stress_near_.back();
  for (std::size_t i = 0; i < std::min(values_.size(), summary_.load_cases.size()); ++i) {
    auto& one = summary_.load_cases[i];
    one.probes = values_[i], one.lines = sums_[i], one.stress_near = stress_near_[i];
  }
  for (const auto& other : others_) post::set_errors(summary_, other, post::sizes_of(content()));
  if (!others_.empty()) return;
  for (auto* some : {&summary_.extremes, &summary_.peaks})
    for (auto& one : *some) one.error.reset();
  for (auto& one : summary_.load_cases)
    for (auto& peak : one.extremes) peak.error.reset();
}

namespace {

/// Warnings of cracks through a part of the thickness that are pressed at their front, by rows of crack_springs.csv.
std::vector<std::string> warnings_about_fronts(const post::Table& rows, const std::vector<plate::Spring>& springs) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < springs.size() && !rows.rows.empty(); ++i) {
    const auto number = [&](const auto& row, const char* column) {
      const auto* found = std::get_if<double>(&row[rows.column(column)]);
      return found && row[rows.column("spring")] == post::Cell(fmt::format("spring{}", i)) ? *found : 0;
    };
    const auto worst = std::ranges::min_element(rows.rows, {}, [&](const auto& row) { return number(row, "K_front"); });
    if (const double least = number(*worst, "K_front"); least < 0)
      result.push_back(fmt::format(
          "spring[{}]: faces overlap where K_front is negative, {:.3g} at ({:.4g}, {:.4g}); set spring[{}].from = "
          "\"{}\" if "
          "the crack begins there",
          i, least, number(*worst, "x"), number(*worst, "y"), i, springs[i].from_below ? "above" : "below"));
  }
  return result;
}

}  // namespace

post::Summary Outputs::finish() {
  set_errors();
  warn(warnings_about_fronts(spring_rows_, content().springs));
  if (!line_rows_.rows.empty()) recorder_.table("lines", std::move(line_rows_));
  if (!spring_rows_.rows.empty()) recorder_.table("crack_springs", std::move(spring_rows_));
  name_settings_by_keys(summary_);
  summary_ = recorder_.finish(std::move(summary_), stopwatch_);
  if (plan_.reports() && recorder_.on_first_process())
    post::write_report(plan_.options.folder, reported(content()), pictures_);
  return summary_;
}

namespace {

/// Warnings of corner forces that bonds do not resolve: a soft support spreads them over about a thickness.
std::vector<std::string> warnings_about_corners(const Case& c, const plate::Formulation& plate) {
  using enum plate::SupportKind;
  const bool soft = std::ranges::any_of(c.supports, [](const plate::Support& one) {
    return one.holds_edges() && (one.kind == simply_supported || one.kind == simply_supported_layer);
  });
  const double most = c.section.thickness / 2;
  if (c.output.edge_reactions == 0 || !soft || !plate.offers(plate::Feature::horizon) ||
      plate.discretization().spacing <= 1.001 * most)
    return {};
  return {
      fmt::format("corner forces of soft simple supports need closer points; set discretization.spacing = {:.2g}, or "
                  "support[].kind = \"simply_supported_hard\"",
                  most)};
}

}  // namespace

PlateAnalysis::PlateAnalysis(const ValidatedPlate& ready, Outputs& outputs)
    : ready_(ready), plate_(*ready.plate), outputs_(outputs) {
  summary() = about(content(), plate_, ready.warnings);
  summary().targets = ready.targets;
  outputs.warn(warnings_about_corners(content(), plate_));
  outputs.open(plate_);
  outputs.compare_with(ready.other_results);
}

plate::NumericalError PlateAnalysis::failed(const plate::NumericalError& error) {
  return placed(error, plate_, summary());
}

post::Summary carry_out(RunningAnalysis& analysis, Outputs& outputs) {
  const plate::StopOnSignals signals;
  const auto end = [&](const std::string& outcome, const std::optional<std::string>& reason) {
    analysis.finish();
    auto& summary = outputs.summary();
    summary.outcome = outcome;
    if (reason) summary.analysis.stop_reason = *reason;
    return outputs.finish();
  };
  try {
    analysis.solve();
  } catch (const plate::NumericalError& error) {
    const auto failed = analysis.failed(error);
    end(fmt::format("failed: {}", failed.what()), failed.what());
    throw failed;
  } catch (const plate::Interrupted& asked) {
    analysis.interrupted();
    end("interrupted", asked.what());
    throw;
  }
  return end("done", {});
}

}  // namespace cases
