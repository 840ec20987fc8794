#include "post/report/reactions.hpp"

#include <algorithm>
#include <functional>

#include "plate/formulation/formulation.hpp"
#include "plate/formulation/inertia.hpp"
#include "plate/model/history.hpp"
#include "plate/model/loading/moving_forces.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/settled.hpp"
#include "post/balance/supports.hpp"

namespace post {
namespace {

Eigen::VectorXd on_held(const plate::Formulation& plate, const plate::Operator& forces, const plate::State& state) {
  plate::Forces internal;
  forces.internal_force(state, internal);
  return plate.constraints().on_held(internal);
}

std::vector<ReactionSummary::Support> supports_of(const plate::Formulation& plate) {
  std::vector<ReactionSummary::Support> result;
  for (const auto& holder : plate.boundary().holders) result.push_back({holder.name, holder.position});
  for (const auto& part : plate.boundary().attached.holding()) result.push_back({part->name, part->position});
  return result;
}

/// Mass times acceleration of every degree of freedom, held or not.
std::function<plate::Forces(const plate::State&)> inertial_force(const plate::Formulation& plate, double rotary,
                                                                 bool of_cells) {
  if (of_cells)
    return [inertia = std::make_shared<plate::Inertia>(plate.inertia(rotary))](const plate::State& acceleration) {
      return inertia->whole(acceleration);
    };
  return [mass = plate::whole_mass(plate, rotary)](const plate::State& acceleration) -> plate::Forces {
    return mass.cwiseProduct(acceleration);
  };
}

plate::Forces pressing(const plate::Blow& blow, Eigen::Index points) {
  plate::Forces result = plate::Forces::Zero(3, points);
  for (const auto& [dof, factor] : blow.terms) plate::at_dof(result, dof) += factor * blow.force;
  return result;
}

}  // namespace

struct ReactionRows::Moving {
  Supports supports;
  std::vector<Applied> loads;
  std::function<plate::Forces(const plate::State&)> inertial_force;

  Moving(const plate::Formulation& plate, double rotary, bool mass_of_cells)
      : supports(plate.boundary()), inertial_force(post::inertial_force(plate, rotary, mass_of_cells)) {
    for (const auto& load : plate.loads()) loads.push_back(supports.applied(load.forces));
  }
};

ReactionRows::ReactionRows(const plate::Formulation& plate, double rotary, bool mass_of_cells, double drag)
    : supports_(supports_of(plate)), plate_(&plate), rotary_(rotary), drag_(drag), mass_of_cells_(mass_of_cells) {}

void ReactionRows::add(const plate::Instant& now, const plate::Operator& forces) {
  if (supports_.empty()) return;
  if (!now.acceleration) return add(now.time, *plate_, forces, now.what_strains(), 1);
  if (!moving_) moving_ = std::make_shared<const Moving>(*plate_, rotary_, mass_of_cells_);
  const auto& [supports, each, inertial_force] = *moving_;
  auto loads = supports.nothing();
  for (std::size_t i = 0; i < each.size(); ++i) {
    const auto& one = plate_->loads()[i];
    const double factor = plate::factor(one.history, now.time);
    loads.add(factor, one.moving ? supports.applied(one.moving->whole(now.time, plate_->points())) : each[i]);
  }
  if (now.blow) loads.add(1, supports.applied(pressing(*now.blow, now.state.cols())));
  plate::State acceleration = now.acceleration();
  if (drag_ > 0) acceleration += drag_ * now.velocity();
  const auto inertia = supports.applied(inertial_force(acceleration));
  const plate::State strained = now.strained ? now.strained() : plate::State();
  const plate::State& state = now.strained ? strained : now.state;
  const auto internal = now.held_force ? *now.held_force : on_held(*plate_, forces, state);
  balances_.emplace_back(now.time, supports.balance(internal, loads, &inertia, state));
}

void ReactionRows::add(double time, const plate::Formulation& plate, const plate::Operator& forces,
                       const plate::State& state, double share) {
  add(time, plate, forces, state, plate::Forces(share * plate::acting_load(plate)));
}

void ReactionRows::add(double time, const plate::Formulation& plate, const plate::Operator& forces,
                       const plate::State& state, const plate::Forces& load) {
  supports_ = supports_of(plate);
  if (supports_.empty()) return;
  const Supports supports(plate.boundary());
  const auto loads = supports.applied(load);
  balances_.emplace_back(time, supports.balance(on_held(plate, forces, state), loads, nullptr, state));
}

Table ReactionRows::table() const {
  Table table{{"time", "support", "x", "y", "force", "moment_x", "moment_y", "residual"}, {}};
  for (const auto& one : balances_) {
    const auto& balance = one.second;
    const auto row = [&, t = one.first](const std::string& name, const std::optional<geometry::Point>& x,
                                        const Wrench& w) {
      table.rows.push_back({t, name, x ? Cell(x->x()) : Cell(), x ? Cell(x->y()) : Cell(), w.force, w.moment_x,
                            w.moment_y, balance.residual});
    };
    for (std::size_t i = 0; i < supports_.size(); ++i)
      row(supports_[i].name, supports_[i].position, balance.supports[i]);
    row("loads", std::nullopt, balance.loads);
    if (balance.inertia) row("inertia", std::nullopt, *balance.inertia);
  }
  return table;
}

std::optional<ReactionSummary> ReactionRows::summary() const {
  if (balances_.empty()) return std::nullopt;
  ReactionSummary result{supports_, balances_.back().first, balances_.back().second, 0, {}};
  for (std::size_t i = 0; i < supports_.size(); ++i) {
    const auto size = [&](const auto& row) { return std::abs(row.second.supports[i].force); };
    const auto& most = *std::ranges::max_element(balances_, {}, size);
    result.largest.push_back({most.first, most.second.supports[i].force});
  }
  for (const auto& [time, balance] : balances_)
    result.largest_residual = std::max(result.largest_residual, balance.residual);
  result.truncation = truncation_;
  return result;
}

}  // namespace post
