#include "fracture/growth/bonds_at_rest.hpp"

#include <cmath>

namespace fracture {
namespace {

constexpr double alike = 1e-5;  // of the demand: mirror images, solved to a residual of 1e-6 or better

std::string end_of_growth(const Growth& growth, const RestLoad::Step& step, std::size_t advances, bool any) {
  if (!any) return "no bond can break";
  if (step.beyond) return advances == 0 ? "no bond breaks under the whole load" : "arrested under the whole load";
  return advances >= growth.max_advances ? "the largest number of advances" : "";
}

}  // namespace

Broken break_at_rest(const Growth& growth, SeveredPlate& plate, BondCheck& check, const std::function<LoadedState()>& solve,
                     const std::function<std::string(const BondEvent&)>& observe) {
  Broken result;
  RestLoad load(growth.control);
  const plate::State none;
  while (true) {
    const auto now = solve();
    if (!now.split.empty()) {
      result.outcome = "the plate split: " + now.split;
      return result;
    }
    const double most = check.largest(*now.state);
    const double critical = most > 0 ? 1 / std::sqrt(most) : INFINITY;
    const auto step = load.to(now.displacement, critical);
    result.ledger.external_work = load.ledger.external_work, result.ledger.strain = load.ledger.strain;
    load.ledger.fracture = result.ledger.fracture;
    result.outcome = end_of_growth(growth, step, result.advances, most > 0);
    if (result.outcome.empty() && !step.stable && growth.unstable != Growth::Unstable::jump) result.outcome = "the next bond breaks unstably";
    BondEvent event{result.advances, critical, step.stable, load, now, {}};
    if (result.outcome.empty()) event.breaks = check.at_least((1 - alike) * most, *now.state);
    const auto why = observe(event);
    if (result.outcome.empty()) result.outcome = why;
    if (!result.outcome.empty()) return result;

    std::vector<PointPair> bonds;
    for (const auto& one : event.breaks) bonds.push_back(one.bond);
    plate.sever(bonds, 1);
    result.ledger.fracture += load.factor() * load.factor() * plate.carry_on_all({*now.state, none, 0});
    ++result.advances;
  }
}

}  // namespace fracture
