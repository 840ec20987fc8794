#include <fmt/format.h>

#include <cmath>

#include "fracture/growth/quasi_static/bonds.hpp"
#include "fracture/growth/quasi_static/growing_plate.hpp"
#include "fracture/growth/words.hpp"
#include "fracture/runs/quasi_static_run.hpp"
#include "fracture/runs/shared/own_drawing.hpp"
#include "plate/model/formulation_kind.hpp"
#include "post/report/curves.hpp"
#include "post/report/overlaps.hpp"

namespace fracture {

void QuasiStaticRun::record() {
  const bool solved = state_.cols() > 0;
  if (solved && !framed_) frame();
  if (solved && recorder_->stores()) store();
  if (tips_ || plan_.srif) recorder_->table("srif", srifs_);
  if (!reactions_.empty()) recorder_->table("reactions", reactions_.table());
  const auto& record = model_->record();
  recorder_->table("growth", record.growth);
  recorder_->table("tips", record.tips);
  recorder_->table("cracks", record.crack_table());
  recorder_->cracks(record.cracks, latest_);
  if (recorder_->plots()) recorder_->picture("curves", post::picture_of_growth(plan_.title, record.growth, plan_.si()));
}

void QuasiStaticRun::store() {
  const auto& plate = model_->plate();
  const auto mesh = post::points_of(plate);
  auto frame = post::frame_of(plate, double(advance_), advance_, state_, false);
  model_->draw(frame, state_);  // its resultants
  if (const auto own = own_drawing(plate, mesh))
    return recorder_->final_state(own->mesh(), own->frame(std::move(frame)));
  recorder_->final_state(mesh, frame);
}

post::GrowthSummary QuasiStaticRun::growth_summary() const {
  post::GrowthSummary growth;
  growth.outcome = in_words(grown_.ended, growth_.by_bonds());
  growth.advances = model_->advances();
  growth.first_load_factor = tips_ ? first_factor_.value_or(0) : first_factor_;
  growth.largest_load_factor = largest_factor_;
  if (first_error_ && std::isfinite(*first_error_)) growth.first_load_factor_error = *first_error_ * *first_factor_;
  growth.broken_bonds = model_->broken_bonds();
  growth.lengths = model_->lengths();
  const auto& books = grown_.ledger;
  if (bonds_)
    growth.spent =
        growth_.spent(books.external_work - books.strain, plan_.problem.section.thickness, bonds_->grown_length());
  return growth;
}

post::Summary QuasiStaticRun::finish() {
  constexpr double much = 0.03;  // as of factors
  record();
  if (grown_.ended.how == End::not_resolved && !first_factor_ && factor_ > 0) first_factor_ = factor_;
  const bool solved = state_.cols() > 0;  // else there may be no plate
  if (solved && doubt_ > much)
    warnings_.push_back(
        fmt::format("load factors are uncertain: {} at advance {} by the estimated errors of the factors (growth.csv, "
                    "critical_load_factor_error); {}",
                    doubt_ >= 1 ? "they mean nothing" : fmt::format("by {:.0f} %", 100 * doubt_), doubtful_,
                    model_->plate().remedy()));
  warnings_.insert(warnings_.end(), model_->warnings().begin(), model_->warnings().end());
  for (auto& one : model_->record().cut_places(plan_.problem)) warnings_.push_back(std::move(one));
  const auto overlaps = post::face_overlaps(srifs_);
  for (auto& one : post::distrust_of_faces(overlaps, plan_.problem.section, {},
                                           [](double advance) { return fmt::format("advance {:g}", advance); }))
    warnings_.push_back(std::move(one));
  post::Summary summary;
  if (solved) summary = about(plan_, model_->plate(), warnings_);
  summary.warnings = warnings_;
  summary.title = plan_.title;
  summary.units = plan_.units;
  summary.formulation = plan_.problem.discretization.formulation->name;
  summary.formulation_reason = plan_.formulation_reason;
  summary.analysis.kind = plate::name_of(plate::Analysis::Kind::static_);
  post::describe(summary.analysis, tips_ ? tips_->method() : "cg", model_->solution(), plan_.analysis.tolerance);
  post::conclude(summary, {plan_.problem.section, plan_.srif, plan_.si(), recorder_->history(), reactions_, latest_});
  summary.overlaps = overlaps;
  summary.growth = growth_summary();
  summary.outcome = "done";
  if (grown_.ended.how == End::failed || grown_.ended.how == End::interrupted)
    summary.outcome = summary.growth->outcome, summary.analysis.stop_reason = grown_.ended.detail;
  const auto& books = grown_.ledger;
  summary.energy = {{"strain", books.strain},
                    {"external_work", books.external_work},
                    {"fracture", books.fracture},
                    {"released", books.released()}};
  summary = recorder_->finish(std::move(summary), stopwatch_);
  write_report(plan_, pictures_);
  return summary;
}

}  // namespace fracture
