#include "fracture/growth/moving_bonds_and_tips.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "fracture/growth/archive.hpp"
#include "fracture/growth/distributed_growth.hpp"
#include "plate/formulation/pieces.hpp"
#include "plate/model/reduction.hpp"
#include "post/factors/plate_factors.hpp"

namespace fracture {

MovingGrowth::MovingGrowth(const Growth& growth, const plate::Formulation& start,
                           std::optional<post::SrifOptions> factors, double rotary_inertia,
                           const plate::Formulation* membrane)
    : growth_(growth),
      start_(start),
      plate_(start, membrane, overlap_of_growth(start, factors || !growth.by_bonds())),
      membrane_(membrane),
      options_(std::move(factors)),
      rotary_inertia_(rotary_inertia) {
  record_.in_motion = true;
  if (!options_) return;
  const auto by_energy = std::ranges::count_if(options_->methods, [](post::SrifMethod m) {
    return m == post::SrifMethod::virtual_crack_extension || m == post::SrifMethod::domain_integral;
  });
  options_->first_ring_only = by_energy == 2;  // one estimates the error of the other
}

plate::Changes& MovingGrowth::changes() {
  if (growth_.detached == Growth::Detached::move) return breakage();
  if (!detached_pieces_) detached_pieces_.emplace(breakage(), plate_, start_.boundary(), start_.mass(rotary_inertia_));
  return *detached_pieces_;
}

std::vector<post::Srif> MovingGrowth::factors(const plate::State& state) const {
  return factors(start_, plate_, state);
}

std::vector<post::Srif> MovingGrowth::factors_in_plane(const plate::State& state) const {
  return factors(*membrane_, *plate_.plane(), state);
}

std::vector<post::Srif> MovingGrowth::factors(const plate::Formulation& start, const DamagedPlate& plate,
                                              const plate::State& state) const {
  std::vector<post::Srif> result;
  if (!options_) return result;
  plate::Forces force;
  plate.internal_force(state, force);
  start.boundary().elastic_supports.take_force(state, force);
  plate.constraints().fetch(force);
  const auto now = paths();
  const auto view = plate.tip_view();
  for (const auto& [number, tip] : tips()) {
    if (!plate.here(tip.position)) continue;
    const auto methods = post::tip_methods(view, start.problem(), now, tip, *options_);
    if (!methods) continue;  // an edge or another crack is too near
    for (auto& srif : (*methods)(state, force, false)) {
      srif.tip = number;
      post::normalize(srif, *options_, start.section().thickness);
      result.push_back(std::move(srif));
    }
  }
  return result;
}

MovingGrowthOutcome MovingGrowth::outcome_so_far() const {
  MovingGrowthOutcome result;
  result.parts = plate::pieces(start_.boundary(), plate_.families()).size();
  result.parts_before = plate::pieces(start_.boundary(), start_.families()).size();
  result.frozen = growth_.detached == Growth::Detached::freeze;
  return result;
}

std::unique_ptr<MovingGrowth> moving_growth(const Growth& growth, const plate::Formulation& start,
                                            std::optional<post::SrifOptions> factors, double rotary_inertia,
                                            const plate::Formulation* membrane) {
  if (growth.by_bonds()) return std::make_unique<MovingBonds>(growth, start, std::move(factors), rotary_inertia);
  return std::make_unique<MovingTips>(growth, start, std::move(factors), rotary_inertia, membrane);
}

namespace {

constexpr std::size_t search_every = 4;  // steps
constexpr unsigned steps_to_break = 4;
constexpr double equal_in_motion = 1e-6;  // of the demand: mirror images break together
constexpr double rounding = 1e-9;         // of the limit: one of them just below it breaks with one at it

}  // namespace

std::vector<LoadedBond> first_to_break(const std::vector<LoadedBond>& failing) {
  std::unordered_map<std::uint32_t, double> taken;  // demand of the first bond of a family
  std::vector<LoadedBond> result;
  for (const auto& one : failing) {
    const auto free = [&](std::uint32_t k) {
      const auto entry = taken.find(k);
      return entry == taken.end() || one.demand >= (1 - equal_in_motion) * entry->second;
    };
    if (!free(one.bond[0]) || !free(one.bond[1])) continue;
    for (const auto k : one.bond) taken.try_emplace(k, one.demand);
    result.push_back(one);
  }
  return result;
}

BreakingBonds::BreakingBonds(DamagedPlate& plate, BondCheck& check, Observe observe)
    : plate_(plate), check_(check), observe_(std::move(observe)) {}

void BreakingBonds::before_force(const plate::Step& now) {
  if (plate_.easing()) plate_.constraints().fetch(now.velocity);
  spent_ += plate_.carry_on_all({now.state, now.velocity, now.time_step});
}

void BreakingBonds::after_force(const plate::Step& now, const plate::Forces&) {
  if (ended_) return;
  if (now.step >= next_search_) {
    suspects_ = check_.suspects(now.state);
    suspected_ = plate::largest_of(plate_.map(), !suspects_.empty()) > 0;
    next_search_ = now.step + search_every;
  }
  if (!suspected_) return;
  const auto failing = check_.at_least(1 - rounding, now.state, suspects_);
  if (failing.empty() || failing.front().demand < 1) return;
  const auto broken = first_to_break(failing);
  plate_.break_bonds(check_.here(broken), steps_to_break);
  ended_ = !observe_(broken, now.time);
}

MovingBonds::MovingBonds(const Growth& growth, const plate::Formulation& start,
                         std::optional<post::SrifOptions> factors, double rotary_inertia)
    : MovingGrowth(growth, start, std::move(factors), rotary_inertia),
      limits_(growth, start.section(), start.discretization()),
      check_(growth, limits_, plate_, start.boundary()),
      cracks_(start, start.section().shear_wave_speed()),
      bonds_(plate_, check_, [this](const auto& bonds, double time) { return broke(bonds, time); }) {}

/// Records broken bonds; returns true where more bonds may break.
bool MovingBonds::broke(const std::vector<LoadedBond>& bonds, double time) {
  const bool new_lines = cracks_.broke(bonds, time);
  if (++advances_ >= growth_.max_advances) return false;
  return !growth_.max_length || !new_lines || !growth_.reached(cracks_.length_now());
}

/// A row of the history is an advance of the record.
void MovingBonds::look(double time) {
  const auto advance = double(record_.growth.rows.size());
  cracks_.look(time, record_, advance);
  for (const auto& tip : cracks_.tips()) largest_speed_ = std::max(largest_speed_, tip.speed);
  GrowthRow row{advance, time};
  row.broken_bonds = double(cracks_.broken()), row.crack_length = cracks_.length(), row.tips = cracks_.tips().size();
  row.fracture_energy = bonds_.fracture_energy();
  record_.add(row);
}

const Record& MovingBonds::record() {
  record_.cracks = cracks_.drawn();
  return record_;
}

MovingGrowthOutcome MovingBonds::outcome() const {
  auto result = outcome_so_far();
  result.broken = cracks_.broken();
  result.advances = advances_;
  result.largest_speed = largest_speed_;
  result.spent = growth_.spent(bonds_.fracture_energy(), start_.section().thickness, cracks_.growth());
  for (const auto& line : cracks_.lines()) result.lengths.push_back(line.length);
  return result;
}

void MovingBonds::save(plate::OutArchive& archive) const {
  memory(archive, *this);
  archive(cracks_, bonds_, advances_, largest_speed_);
}

void MovingBonds::restore(plate::InArchive& archive) {
  memory(archive, *this);
  archive(cracks_, bonds_, advances_, largest_speed_);
}

MovingTips::MovingTips(const Growth& growth, const plate::Formulation& start, std::optional<post::SrifOptions> factors,
                       double rotary_inertia, const plate::Formulation* membrane)
    : MovingGrowth(growth, start, std::move(factors), rotary_inertia, membrane),
      cracks_(growth, start.problem(), plate_, start.paths(), membrane ? &membrane->problem() : nullptr) {}

const Record& MovingTips::record() {
  record_ = {};
  record_.in_motion = true;
  double length = 0, spent = 0;
  for (const auto& path : start_.paths()) {
    record_.cracks.lines.push_back({path.vertices, std::vector<double>(path.vertices.size(), 0)});
    length += geometry::length(path.vertices);
  }
  const auto add = [&](const Piece& piece) {
    auto& [vertices, times] = record_.cracks.lines[piece.crack];
    vertices.insert(piece.at_back ? vertices.end() : vertices.begin(), piece.to);
    times.insert(piece.at_back ? times.end() : times.begin(), piece.end);
  };
  std::size_t drawn = 0;  // pieces; those that end at once go together
  for (std::size_t i = 0; i < cracks_.pieces().size(); ++i) {
    const auto& piece = cracks_.pieces()[i];
    const geometry::Point step = piece.to - piece.from;
    for (; drawn < cracks_.pieces().size() && cracks_.pieces()[drawn].end == piece.end; ++drawn)
      add(cracks_.pieces()[drawn]);
    const auto& vertices = record_.cracks.lines[piece.crack].vertices;
    TipRow tip{double(i), piece.end, double(piece.tip), double(piece.crack), piece.to.x(), piece.to.y()};
    tip.angle = std::atan2(step.y(), step.x()) * 180 / std::numbers::pi;
    tip.length = geometry::length(vertices);
    tip.begin = piece.begin, tip.piece = step.norm(), tip.speed = step.norm() / (piece.end - piece.begin),
    tip.spent = piece.spent;
    tip.reached = piece.reached;
    record_.add(tip);
    length += step.norm();
    spent += piece.spent * growth_.fracture_energy * start_.section().thickness * step.norm();
    GrowthRow row{double(i), piece.end};
    row.crack_length = length, row.tips = piece.tips, row.fracture_energy = spent;
    record_.add(row);
  }
  for (const auto& [number, tip] : cracks_.tips()) record_.cracks.tips.push_back({number, tip.crack, tip.position});
  return record_;
}

MovingGrowthOutcome MovingTips::outcome() const {
  auto result = outcome_so_far();
  const auto& pieces = cracks_.pieces();
  result.advances = pieces.size(), result.under_way = cracks_.under_way();
  for (const auto& piece : pieces) {
    if (!piece.reached.empty()) result.reached.push_back(piece.reached);
    result.largest_speed = std::max(result.largest_speed, (piece.to - piece.from).norm() / (piece.end - piece.begin));
  }
  for (const auto& [time, tip, position, asked, error, spent] : cracks_.stopped()) {
    const auto where = fmt::format("tip {} at ({:g}, {:g}) at t = {:.4g}", tip, position.x(), position.y(), time);
    if (spent > 0)
      result.unsteady.push_back(
          fmt::format("{} took {:.2g} times the fracture energy over five spacings", where, spent));
    else
      result.stopped.push_back(fmt::format("{} would turn by {:.0f} degrees, known to {:.0f} only", where,
                                           asked * 180 / std::numbers::pi, error * 180 / std::numbers::pi));
  }
  result.direction_unknown = cracks_.direction_unknown();
  if (!pieces.empty())
    result.spent = growth_.spent(cracks_.fracture_energy(), start_.section().thickness, cracks_.length());
  for (const auto& path : cracks_.paths()) result.lengths.push_back(geometry::length(path.vertices));
  return result;
}

void MovingTips::save(plate::OutArchive& archive) const {
  memory(archive, *this);
  archive(cracks_);
}

void MovingTips::restore(plate::InArchive& archive) {
  memory(archive, *this);
  archive(cracks_);
}

}  // namespace fracture
