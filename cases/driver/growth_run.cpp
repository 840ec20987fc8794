#include "cases/driver/growth_run.hpp"

#include <fmt/format.h>

#include "cases/driver/discretised.hpp"
#include "cases/driver/results.hpp"
#include "cases/report/scene.hpp"
#include "fracture/growth/quasi_static/bonds.hpp"
#include "fracture/growth/quasi_static/growing_plate.hpp"
#include "fracture/growth/words.hpp"
#include "plate/model/numerical_error.hpp"
#include "post/files/gate.hpp"
#include "post/report/conclusion.hpp"
#include "post/report/curves.hpp"
#include "post/report/progress.hpp"
#include "post/report/reactions.hpp"

namespace cases {
namespace {

/// A quasi-static growth and what is recorded of it, with the number of the advance in the place of time.
class GrowthRun {
public:
  GrowthRun(const CaseFile& file, const RunOptions& options);

  post::Summary operator()(bool quiet);

  // of the end
  const fracture::Grown& grown() const { return grown_; }
  double load_factor() const { return factor_; }
  std::vector<geometry::Polyline> cracks() const { return tips_ ? tips_->cracks() : case_.cracks; }

private:
  void observe(const fracture::Equilibrium& now);
  void frame();
  post::Summary finish();

  const Case& case_;
  plate::Stopwatch stopwatch_;
  std::vector<std::string> warnings_;
  std::unique_ptr<plate::Formulation> start_;  // of bonds
  std::unique_ptr<fracture::GrowingPlate> tips_;
  std::unique_ptr<fracture::QuasiStaticBonds> bonds_;
  fracture::QuasiStaticModel* model_ = nullptr;
  std::optional<post::Recorder> recorder_;       // once nothing can be refused any more
  std::optional<std::filesystem::path> report_;  // its folder, where one is wanted
  post::Pictures pictures_;                      // for it
  post::ReactionRows reactions_;
  post::Table srifs_{post::srif_columns(), {}};
  std::vector<post::Srif> latest_;
  plate::State state_;  // of the last advance
  fracture::Grown grown_;
  std::size_t advance_ = 0;  // its number
  double factor_ = 0, largest_factor_ = 0;
  std::optional<double> first_factor_;
  bool framed_ = true;
};

/// Where the case asks for no intensity factors, the methods that give the energy release rate.
post::SrifOptions options_of_factors(const Case& c) {
  post::SrifOptions standard;
  standard.methods = {"virtual_crack_extension", "domain_integral"};
  return c.srif.value_or(standard);
}

GrowthRun::GrowthRun(const CaseFile& file, const RunOptions& options) : case_(file.content) {
  const Case& c = case_;
  CaseFile with_factors = file;
  if (!c.growth->by_bonds()) with_factors.content.srif = options_of_factors(c);
  auto found = discretised(with_factors);
  stopwatch_ = found.stopwatch;
  const plate::StaticOptions statics{c.analysis.tolerance, c.analysis.max_iterations, {}};
  if (c.growth->by_bonds()) {
    tip_methods(file, *found.plate);  // for what they refuse
    start_ = std::move(found.plate), warnings_ = found.warnings;
    bonds_ = std::make_unique<fracture::QuasiStaticBonds>(*c.growth, *start_, c.srif, statics);
    model_ = bonds_.get();
  } else {
    check_growing_tips(file, *found.plate, found.warnings);
    tip_methods(with_factors, *found.plate);  // for what they refuse
    warnings_ = found.warnings;
    const fracture::StaticSolver solver{c.analysis.static_method(), c.analysis.preconditioner, statics};
    tips_ = std::make_unique<fracture::GrowingPlate>(*c.growth, c, std::move(found), options_of_factors(c), solver,
                                                     stopwatch_);
    model_ = tips_.get();
  }
  recorder_.emplace(recorder_of(c, options));
  report_ = report_folder(c, options);
}

post::Summary GrowthRun::operator()(bool quiet) {
  const Case& c = case_;
  post::Progress progress(quiet, "growth");
  try {
    grown_ = fracture::grow_quasi_statically(*c.growth, *model_, [&](const fracture::Equilibrium& now) {
      stopwatch_.lap("solve");
      observe(now);
      stopwatch_.lap("output");
      double length = 0;
      for (const double one : model_->lengths()) length += one;
      progress.update(
          double(now.advance) / double(c.growth->max_advances),
          fmt::format("advance {}, load factor {:.4g}, crack length {:.4g}", now.advance, now.factor, length));
    });
    progress.done();
    return finish();
  } catch (const plate::NumericalError& error) {
    grown_.ended = {fracture::End::failed, error.what()};
    finish();
    throw;
  }
}

void GrowthRun::observe(const fracture::Equilibrium& now) {
  const auto& plate = model_->plate();
  const auto time = double(now.advance);
  advance_ = now.advance, factor_ = now.factor;
  const auto when = fmt::format("at advance {}", now.advance);
  post::require_finite(model_->state(), when);
  state_ = now.factor * model_->state();
  post::Sample row{time, now.advance, state_, now.ledger.strain, 0, now.ledger.external_work, now.ledger.fracture};
  row.released_energy = now.ledger.released(), row.load_factor = now.factor, row.displacement = now.displacement;
  recorder_->row(row, probes_of(case_, plate), plate.cloud().plate_points);
  reactions_.add(time, plate, model_->forces(), state_, now.factor);
  if (auto factors = model_->factors(now.factor)) {
    post::require_finite(*factors, when);
    post::append(srifs_, time, *factors);
    latest_ = std::move(*factors);
  }
  if (!now.ends && !first_factor_) first_factor_ = now.factor;
  largest_factor_ = std::max(largest_factor_, now.factor);
  grown_.ledger = now.ledger;
  framed_ = false;
  if (now.advance % case_.growth->frames_every == 0) frame();
}

void GrowthRun::frame() {
  framed_ = true;
  if (!recorder_->draws()) return;
  auto frame = post::frame_of(model_->plate(), double(advance_), advance_, state_, false);
  auto mesh = model_->draw(frame, state_);
  if (report_) pictures_.open(mesh), pictures_.look(frame);
  post::set_factors(*frame.cracks, latest_);
  recorder_->frame(std::move(frame), std::move(mesh), {});
}

post::Summary GrowthRun::finish() {
  const Case& c = case_;
  const bool solved = state_.cols() > 0;
  if (solved && !framed_) frame();
  if (solved && recorder_->stores())
    recorder_->final_state(post::points_of(model_->plate()),
                           post::frame_of(model_->plate(), double(advance_), advance_, state_, false));
  if (tips_ || c.srif) recorder_->table("srif", srifs_);
  if (!reactions_.empty()) recorder_->table("reactions", reactions_.table());
  const auto& record = model_->record();
  recorder_->table("growth", record.growth);
  recorder_->table("tips", record.tips);
  recorder_->table("cracks", record.crack_table());
  recorder_->cracks(record.cracks, latest_);
  if (recorder_->plots())
    recorder_->picture("curves", post::to_svg(post::curves_of_growth(c.title, record.growth, c.units == "SI")));
  warnings_.insert(warnings_.end(), model_->warnings().begin(), model_->warnings().end());
  post::Summary summary;
  if (solved) summary = about(c, model_->plate(), warnings_);
  summary.warnings = warnings_;
  summary.title = c.title;
  summary.formulation = c.discretization.formulation->name;
  summary.formulation_reason = c.formulation_reason;
  summary.analysis.kind = "static";
  post::describe(summary.analysis, tips_ ? tips_->method() : "cg", model_->solution(), c.analysis.tolerance);
  summary.outcome = "done";
  const auto words = fracture::in_words(grown_.ended, c.growth->by_bonds());
  if (grown_.ended.how == fracture::End::failed)
    summary.outcome = words, summary.analysis.stop_reason = grown_.ended.detail;
  post::conclude(summary, {c.section, c.srif, c.units == "SI", recorder_->history(), reactions_, latest_});
  auto& growth = summary.growth.emplace();
  growth.outcome = words;
  growth.advances = model_->advances();
  growth.first_load_factor = tips_ ? first_factor_.value_or(0) : first_factor_;
  growth.largest_load_factor = largest_factor_;
  growth.broken_bonds = model_->broken_bonds();
  growth.lengths = model_->lengths();
  const auto& books = grown_.ledger;
  if (bonds_)
    growth.spent = c.growth->spent(books.external_work - books.strain, c.section.thickness, bonds_->grown_length());
  summary.energy = {{"strain", books.strain},
                    {"external_work", books.external_work},
                    {"fracture", books.fracture},
                    {"released", books.released()}};
  summary = recorder_->finish(std::move(summary), stopwatch_);
  if (report_) write_report(c, *report_, pictures_);
  return summary;
}

/// The plate as it has grown quasi-statically, a hundredth above the load that is there, and what it does then.
CaseFile in_motion(CaseFile file, const GrowthRun& run) {
  Case& c = file.content;
  c.analysis.kind = Analysis::Kind::dynamic;
  c.analysis.method = Analysis::Method::central_difference;
  c.analysis.start = Analysis::Start::equilibrium;
  c.analysis.duration = c.growth->duration;
  c.growth->unstable = fracture::Growth::Unstable::jump;
  c.output.every = c.growth->duration / 10;
  c.cracks = run.cracks();
  const double factor = 1.01 * run.load_factor();
  for (auto& load : c.loads) {
    load.value *= factor, load.twist *= factor;
    for (auto& component : load.tensor) component *= factor;
    load.history = {};
  }
  return file;
}

}  // namespace

post::Summary grow(const CaseFile& file, const RunOptions& options) {
  GrowthRun growth(file, options);
  auto summary = growth(options.quiet);
  if (growth.grown().ended.how == fracture::End::unstable &&
      file.content.growth->unstable == fracture::Growth::Unstable::move)
    run(in_motion(file, growth), options.part("motion"));
  return summary;
}

}  // namespace cases
