#include "fracture/runs/quasi_static_run.hpp"

#include <fmt/format.h>

#include <cmath>

#include "fracture/growth/quasi_static/bonds.hpp"
#include "fracture/growth/quasi_static/growing_plate.hpp"
#include "fracture/runs/shared/own_drawing.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/model/numerical_error.hpp"
#include "plate/solve/interruption.hpp"
#include "post/files/gate.hpp"
#include "post/report/progress.hpp"

namespace fracture {

post::SrifOptions factors_of_growth(const std::optional<post::SrifOptions>& asked) {
  post::SrifOptions standard;
  standard.methods = {"virtual_crack_extension", "domain_integral"};
  return asked.value_or(standard);
}

QuasiStaticRun::QuasiStaticRun(const RunPlan& plan, plate::Discretised first)
    : plan_(plan), growth_(*plan.growth), stopwatch_(first.stopwatch), warnings_(first.warnings) {
  const auto& analysis = plan_.analysis;
  const plate::StaticOptions statics{analysis.tolerance, analysis.max_iterations, {}};
  if (growth_.by_bonds()) {
    start_ = std::move(first.plate);
    bonds_ = std::make_unique<QuasiStaticBonds>(growth_, *start_, plan_.srif, statics);
    model_ = bonds_.get();
  } else {
    const StaticSolver solver{analysis.static_method(), analysis.preconditioner, statics};
    tips_ = std::make_unique<GrowingPlate>(growth_, plan_.problem, std::move(first), factors_of_growth(plan_.srif),
                                           solver, stopwatch_);
    model_ = tips_.get();
  }
}

QuasiStaticRun::~QuasiStaticRun() = default;

std::vector<geometry::Polyline> QuasiStaticRun::cracks() const {
  return tips_ ? tips_->cracks() : plan_.problem.cracks;
}

post::Summary QuasiStaticRun::operator()(post::Recorder recorder, Keeper* keeper) {
  recorder_.emplace(std::move(recorder));
  post::Progress progress(plan_.quiet, "growth");
  const plate::StopOnSignals signals;
  QuasiStaticLoad load(growth_.control);
  const auto see = [&](const Equilibrium& now) {
    stopwatch_.lap("solve");
    observe(now);
    stopwatch_.lap("output");
    double length = 0;
    for (const double one : model_->lengths()) length += one;
    progress.update(
        double(now.advance) / double(growth_.max_advances),
        fmt::format("advance {}, load factor {:.4g}, crack length {:.4g}", now.advance, now.factor, length));
  };
  try {
    grown_ = grow_quasi_statically(growth_, *model_, see, keeper ? continuation(*keeper, load) : Continuation{});
    progress.done();
    return finish();
  } catch (const plate::NumericalError& error) {
    const auto failed = error.point ? placed(error, model_->plate(), {}) : error;  // without one, there may be no plate
    grown_.ended = {End::failed, failed.what()};
    finish();
    throw failed;
  } catch (const plate::Interrupted& asked) {
    grown_.ended = {End::interrupted, asked.what()};
    write_held(keeper);
    finish();
    throw;
  }
}

void QuasiStaticRun::observe(const Equilibrium& now) {
  const auto& plate = model_->plate();
  const auto time = double(now.advance);
  advance_ = now.advance, factor_ = now.factor;
  const auto when = fmt::format("at advance {}", now.advance);
  post::require_finite(model_->state(), when);
  state_ = now.factor * model_->state();
  post::Sample row{time, now.advance, state_, now.ledger.strain, 0, now.ledger.external_work, now.ledger.fracture};
  row.released_energy = now.ledger.released(), row.load_factor = now.factor, row.displacement = now.displacement;
  recorder_->row(row, probes_of(plan_.probes, plate), plate.boundary());
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
  grown_.ledger = now.ledger;
  framed_ = false;
  if (now.advance % growth_.frames_every == 0) frame();
}

void QuasiStaticRun::frame() {
  framed_ = true;
  if (!recorder_->draws()) return;
  auto frame = post::frame_of(model_->plate(), double(advance_), advance_, state_, false);
  auto mesh = model_->draw(frame, state_);
  post::set_factors(*frame.cracks, latest_);
  if (const auto own = own_drawing(model_->plate(), mesh))
    return recorder_->frame(own->frame(std::move(frame)), own->mesh(), {});
  if (plan_.report) pictures_.open(mesh), pictures_.look(frame);
  recorder_->frame(std::move(frame), std::move(mesh), {});
}

}  // namespace fracture
