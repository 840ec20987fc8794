#include "cases/runs/quasi_static_run.hpp"

#include <fmt/format.h>
#include <cmath>

#include "cases/runs/checkpoints.hpp"
#include "fracture/growth/growing_plate.hpp"
#include "fracture/growth/growth.hpp"
#include "fracture/growth/quasi_static_bonds.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/numerical_method.hpp"
#include "plate/solve/archive.hpp"
#include "plate/solve/interruption.hpp"
#include "post/files/archive.hpp"
#include "post/files/result_checks.hpp"
#include "post/report/conclusion.hpp"
#include "post/report/curves.hpp"
#include "post/report/overlaps.hpp"
#include "post/report/terminal.hpp"

namespace cases {

post::SrifOptions factors_of_growth(const std::optional<post::SrifOptions>& asked) {
  post::SrifOptions standard;
  standard.methods = {post::SrifMethod::virtual_crack_extension, post::SrifMethod::domain_integral};
  return asked.value_or(standard);
}

QuasiStaticRun::QuasiStaticRun(const RunPlan& plan, plate::Discretised first)
    : plan_(plan),
      content_(plan.content),
      growth_(*content_.growth),
      stopwatch_(first.stopwatch),
      warnings_(first.warnings) {
  const auto& analysis = content_.analysis;
  if (growth_.by_bonds()) {
    start_ = std::move(first.plate);
    bonds_ = std::make_unique<fracture::QuasiStaticBonds>(
        growth_, *start_, content_.srif, plate::StaticOptions{analysis.tolerance, analysis.max_iterations, {}});
    model_ = bonds_.get();
  } else {
    tips_ = std::make_unique<fracture::GrowingPlate>(growth_, content_, std::move(first),
                                                     factors_of_growth(content_.srif), analysis, stopwatch_);
    model_ = tips_.get();
  }
}

QuasiStaticRun::~QuasiStaticRun() = default;

std::vector<geometry::Polyline> QuasiStaticRun::cracks() const {
  return tips_ ? tips_->cracks() : content_.cracks;
}

post::Summary QuasiStaticRun::operator()(post::Recorder recorder, RunCheckpoints* checkpoints) {
  outputs_.emplace(plan_, std::move(recorder), stopwatch_);
  reactions_.along_edges(content_.output.edge_reactions);
  checkpoints_ = checkpoints;
  return carry_out(*this, *outputs_);
}

void QuasiStaticRun::solve() {
  post::Progress progress(plan_.options.quiet, "growth");
  fracture::QuasiStaticLoad load(growth_.control);
  const auto see = [&](const fracture::Equilibrium& now) {
    stopwatch_.lap("solve");
    observe(now);
    stopwatch_.lap("output");
    double length = 0;
    for (const double one : model_->lengths()) length += one;
    progress.update(
        double(now.advance) / double(growth_.max_advances),
        fmt::format("advance {}, load factor {:.4g}, crack length {:.4g}", now.advance, now.factor, length));
  };
  outcome_ = fracture::grow_quasi_statically(
      growth_, *model_, see, checkpoints_ ? continuation(*checkpoints_, load) : fracture::Continuation{});
  progress.done();
}

plate::NumericalError QuasiStaticRun::failed(const plate::NumericalError& error) {
  const auto result = error.point ? placed(error, model_->plate(), {}) : error;  // without one, there may be no plate
  outcome_.ended = {fracture::End::failed, result.what()};
  return result;
}

void QuasiStaticRun::interrupted() {
  outcome_.ended = {fracture::End::interrupted, {}};
  if (checkpoints_) checkpoints_->write();
}

void QuasiStaticRun::observe(const fracture::Equilibrium& now) {
  const auto& plate = model_->plate();
  const auto time = double(now.advance);
  advance_ = now.advance, factor_ = now.factor;
  const auto when = fmt::format("at advance {}", now.advance);
  post::require_finite(model_->state(), when, plate);
  state_ = now.factor * model_->state();
  post::Sample row{time, now.advance, state_, now.ledger.strain, 0, now.ledger.external_work, now.ledger.fracture};
  row.released_energy = now.ledger.released(), row.load_factor = now.factor, row.displacement = now.displacement;
  const auto plane = in_plane();
  if (plane) row.in_plane = &plane->fields.displacement;
  outputs_->place_probes(plate);
  outputs_->row(row, plate);
  reactions_.add(time, plate, model_->forces(), state_, now.factor);
  if (auto factors = model_->factors(now.factor)) {
    post::require_finite(*factors, when);
    post::append(srifs_, time, *factors);
    latest_ = std::move(*factors);
  }
  if (tips_ && !first_factor_) first_error_ = now.critical_error;
  if (!now.ends && !first_factor_) first_factor_ = now.factor;
  if (std::isfinite(now.critical) && now.critical_error > doubt_) doubt_ = now.critical_error, doubtful_ = advance_;
  largest_factor_ = std::max(largest_factor_, now.factor);
  outcome_.ledger = now.ledger;
  framed_ = false;
  if (now.advance % growth_.frames_every == 0) frame();
}

void QuasiStaticRun::frame() {
  framed_ = true;
  if (!outputs_->recorder().draws()) return;
  auto [frame, mesh] = drawn();
  post::set_factors(*frame.cracks, latest_);
  outputs_->frame(model_->plate(), std::move(frame), std::move(mesh));
}

/// The last advance as it is drawn.
std::pair<post::Frame, plate::Mesh> QuasiStaticRun::drawn() const {
  std::pair result{post::frame_of(model_->plate(), double(advance_), advance_, state_, false), plate::Mesh{}};
  auto& [frame, mesh] = result;
  mesh = model_->draw(frame, state_);
  if (const auto plane = in_plane()) add_in_plane(frame, model_->plate(), *tips_->membrane(), *plane);
  return result;
}

/// The plate in its plane at the last advance; none where nothing acts there.
std::optional<MembraneResult> QuasiStaticRun::in_plane() const {
  const auto* membrane = tips_ ? tips_->membrane() : nullptr;
  if (!membrane) return std::nullopt;
  return membrane_results(*membrane, factor_ * tips_->state_in_plane(), factor_ * membrane->total_load(),
                          plate::heat_of(*membrane, factor_), {{}, {}},
                          fmt::format("in the plane at advance {}", advance_));
}

template <typename Archive>
void QuasiStaticRun::memory(Archive& archive) {
  auto& [work, strain, fracture] = outcome_.ledger;
  archive(reactions_, srifs_, latest_, work, strain, fracture, advance_, factor_, largest_factor_, doubt_, doubtful_,
          first_factor_, first_error_, framed_);
}

/// `load`: to go on from.
fracture::Continuation QuasiStaticRun::continuation(RunCheckpoints& checkpoints, fracture::QuasiStaticLoad& load) {
  auto* const points = model_->of_points();
  const bool goes_on = checkpoints.restore([&](plate::InArchive& archive) {
    archive(load);
    outputs_->restore(archive);
    memory(archive);
    model_->restore(archive);
  });
  if (goes_on && points) {
    const auto complete = [this](plate::State&) { model_->restored_points(); };
    put_values(model_->plate().boundary(), checkpoints.parts(), {{points, complete}});
  }
  if (goes_on) state_ = factor_ * model_->state();
  const auto hold = [this, &checkpoints, points](const fracture::QuasiStaticLoad& now) {
    const auto save_state = [&](plate::OutArchive& archive) {
      archive(now);
      outputs_->save(archive);
      memory(archive);
      model_->save(archive);
    };
    checkpoints.hold(save_state, [this, points] {
      return points ? own_values(model_->plate().boundary(), {points}) : post::CellValues{};
    });
  };
  return {goes_on ? &load : nullptr, hold};
}

void QuasiStaticRun::record() {
  auto& recorder = outputs_->recorder();
  const bool solved = state_.cols() > 0;
  if (solved && !framed_) frame();
  if (solved && recorder.stores()) {
    outputs_->final_state(model_->plate(), drawn().first);
  }
  if (tips_ || content_.srif) recorder.table("srif", srifs_);
  post::record(reactions_, recorder);
  const auto& record = model_->record();
  recorder.table("growth", record.growth);
  recorder.table("tips", record.tips);
  recorder.table("cracks", record.crack_table());
  recorder.cracks(record.cracks, latest_);
  if (recorder.plots())
    recorder.picture("curves", post::picture_of_growth(content_.title, record.growth, content_.si()));
}

post::GrowthSummary QuasiStaticRun::growth_summary() const {
  post::GrowthSummary growth;
  growth.outcome = fracture::in_words(outcome_.ended, growth_.by_bonds());
  growth.resolved = outcome_.ended.how != fracture::End::not_resolved;
  growth.advances = model_->advances();
  growth.first_load_factor = tips_ ? first_factor_.value_or(0) : first_factor_;
  growth.largest_load_factor = largest_factor_;
  if (first_factor_ && first_error_ && std::isfinite(*first_error_))
    growth.first_load_factor_error = *first_error_ * *first_factor_;
  growth.broken_bonds = model_->broken_bonds();
  growth.lengths = model_->lengths();
  const auto& energies = outcome_.ledger;
  if (bonds_)
    growth.spent =
        growth_.spent(energies.external_work - energies.strain, content_.section.thickness, bonds_->grown_length());
  return growth;
}

void QuasiStaticRun::finish() {
  constexpr double much = 0.03;  // as of factors
  record();
  if (outcome_.ended.how == fracture::End::not_resolved && !first_factor_ && factor_ > 0) first_factor_ = factor_;
  const bool solved = state_.cols() > 0;  // else there may be no plate
  if (solved && doubt_ > much)
    warnings_.push_back(
        fmt::format("load factors are uncertain: by {} at advance {} (critical_load_factor_error); {}",
                    doubt_ >= 1 ? "100 % or more" : fmt::format("{:.0f} %", 100 * doubt_), doubtful_,
                    bonds_ ? fmt::format("set discretization.spacing = {:.2g}", content_.discretization.spacing / 2)
                           : model_->plate().remedy()));
  warnings_.insert(warnings_.end(), model_->warnings().begin(), model_->warnings().end());
  for (auto& one : model_->record().cut_places(content_)) warnings_.push_back(std::move(one));
  const auto plane = solved ? in_plane() : std::nullopt;
  const auto overlaps = plane ? std::vector<post::FaceOverlaps>() : post::face_overlaps(srifs_);
  for (auto& one : post::warnings_about_faces(
           overlaps, content_.section, {}, [](double advance) { return fmt::format("advance {:g}", advance); },
           solved && may_touch(content_, model_->plate())))
    warnings_.push_back(std::move(one));
  auto& summary = outputs_->summary();
  if (solved) summary = about(content_, model_->plate(), warnings_);
  summary.warnings = warnings_;
  summary.title = content_.title;
  summary.units = content_.units;
  summary.formulation = content_.discretization.formulation->name;
  summary.formulation_reason = content_.formulation_reason;
  summary.recipe = content_.recipe_keys;
  summary.analysis.kind = plate::Analysis::Kind::static_;
  post::describe(summary.analysis, tips_ ? tips_->method() : "cg", model_->solution(), content_.analysis.tolerance);
  post::conclude(summary, {.section = content_.section,
                           .options = content_.srif,
                           .si = content_.si(),
                           .history = outputs_->recorder().history(),
                           .reactions = reactions_,
                           .factors = latest_,
                           .may_stretch = false});
  if (plane) {
    if (!content_.faces_touch()) outputs_->warn(warnings_about_overlaps(latest_, true));
    summary.membrane = plane->summary, summary.contact = tips_->contact(factor_);
  }
  summary.overlaps = overlaps;
  summary.growth = growth_summary();
  const auto& energies = outcome_.ledger;
  summary.energy = {{"strain", energies.strain},
                    {"external_work", energies.external_work},
                    {"fracture", energies.fracture},
                    {"released", energies.released()}};
}

}  // namespace cases
