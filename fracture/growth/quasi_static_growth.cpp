#include "fracture/growth/quasi_static_growth.hpp"

#include <cmath>

#include "plate/solve/interruption.hpp"

namespace fracture {
namespace {

std::optional<End> end_of(const Growth& growth, const QuasiStaticModel& model, const Loaded& plate,
                          const QuasiStaticLoad::Step& step) {
  if (plate.end) return plate.end;
  if (step.beyond) return model.advances() == 0 ? End::no_growth : End::arrested;
  if (model.advances() >= growth.max_advances) return End::most_advances;
  if (model.longest()) return End::longest;
  if (!step.stable && growth.unstable != Growth::Unstable::jump) return End::unstable;
  if (!plate.unresolved.empty()) return End::not_resolved;
  return std::nullopt;
}

}  // namespace

GrowthRow row_of(const Equilibrium& state) {
  GrowthRow row{double(state.advance), {}, state.factor, state.displacement, {}, double(state.stable)};
  if (std::isfinite(state.critical)) row.critical_load_factor = state.critical;
  row.external_work = state.ledger.external_work, row.strain_energy = state.ledger.strain;
  row.fracture_energy = state.ledger.fracture, row.released_energy = state.ledger.released();
  return row;
}

QuasiStaticOutcome grow_quasi_statically(const Growth& growth, QuasiStaticModel& model,
                                         const std::function<void(const Equilibrium&)>& observe,
                                         const Continuation& continuation) {
  QuasiStaticOutcome result;
  QuasiStaticLoad load(growth.control);
  const auto energies = [&] {
    const double heated = model.heated(load.factor());
    return Ledger{load.ledger.external_work + heated, load.ledger.strain + heated, model.fracture_energy()};
  };
  const auto goes_on = [&] {
    model.advance(load.factor());
    if (auto why = model.stuck(); !why.empty()) result.ended = {End::not_resolved, std::move(why)};
    return result.ended.how != End::not_resolved;
  };
  if (continuation.from) {
    load = *continuation.from;
    result.ledger = energies();
    if (!goes_on()) return result;
  }
  while (true) {
    const auto plate = model.solve();
    if (!plate.split.empty()) {
      result.ended = {End::split, plate.split};
      return result;
    }
    const auto step = load.to(plate.displacement, plate.critical, plate.held);
    result.ledger = energies();
    const auto end = end_of(growth, model, plate, step);
    const Equilibrium state{model.advances(), load.factor(),   load.displacement(), plate.critical,
                            step.stable,      end.has_value(), result.ledger,       plate.error};
    model.choose(state);
    observe(state);
    if (end) {
      result.ended = {*end, *end == End::not_resolved ? plate.unresolved : ""};
      return result;
    }
    if (continuation.hold) continuation.hold(load);
    plate::stop_if_asked("a quasi-static growth", model.constraints());
    if (!goes_on()) return result;
  }
}

}  // namespace fracture
