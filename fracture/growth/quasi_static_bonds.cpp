#include "fracture/growth/quasi_static_bonds.hpp"

#include <fmt/format.h>
#include <cmath>

#include "fracture/growth/archive.hpp"
#include "fracture/growth/distributed_growth.hpp"
#include "plate/formulation/pieces.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/factorised_plate.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/files/result_checks.hpp"

namespace fracture {
namespace {

constexpr double equal_demand = 1e-5;  // of the demand: mirror images, solved to a residual of 1e-6 or better

}  // namespace

QuasiStaticBonds::QuasiStaticBonds(const Growth& growth, const plate::Formulation& start,
                                   std::optional<post::SrifOptions> factors, const plate::StaticOptions& options)
    : growth_(growth),
      start_(start),
      options_of_factors_(std::move(factors)),
      options_(options),
      plate_(*start.breaking(), start.boundary(), {start.section(), start.discretization()},
             overlap_of_growth(start, options_of_factors_.has_value())),
      limits_(growth, start.section(), start.discretization()),
      check_(growth, limits_, plate_, start.boundary()),
      cracks_(start),
      load_(start.total_load()),
      state_(plate::zero_state(load_.cols())) {
  diagonal_ = plate::folded_diagonal(plate_, start.constraints());
  norm_ = norm(load_);
  if (!start.may_move())  // the factor would enlarge the rounding of a motion without resistance
    factor_ = start.preconditioner(plate::Preconditioning::two_level).inverse;
  cracks_.look(0, record_, 0);
}

QuasiStaticBonds::~QuasiStaticBonds() = default;

Loaded QuasiStaticBonds::solve() {
  const bool broken = cracks_.broken() > 0;
  if (auto free = broken ? free_pieces() : ""; !free.empty()) return {std::move(free), 0, 0, {}};
  try {
    find_state();
  } catch (const plate::NotPositive&) {
    if (!broken) throw;
    return {"a part hangs by its last bonds and can turn about them", 0, 0, {}};
  }
  Loaded result{"", 2 * post::slow_work(start_, state_), INFINITY, {}};
  most_ = check_.largest(state_);
  if (most_ > 0)
    result.critical = 1 / std::sqrt(most_);
  else
    result.end = End::cannot_grow;
  if (advances_ == 0) post::require_motion(start_, {load_}, state_, result.displacement, warnings_);
  return result;
}

std::string QuasiStaticBonds::free_pieces() const {
  std::string free;
  for (const auto& piece : plate::pieces(start_.boundary(), plate_.families()))
    if (piece.free_modes > 0)
      free += fmt::format("{}the piece of {} points about ({:g}, {:g}) is not held", free.empty() ? "" : "; ",
                          piece.points, piece.position.x(), piece.position.y());
  return free;
}

/// The residual of the last state is the load of its change.
void QuasiStaticBonds::find_state() {
  plate::Forces rest;
  plate_.internal_force(state_, rest);
  rest += load_;
  const double left = norm(rest) / norm_;
  const double tolerance = std::min(options_.tolerance, 1e-6);
  if (left <= tolerance) return;
  const auto change = plate::conjugate_gradients(plate_, plate_.constraints(), rest,
                                                 {tolerance / left, options_.max_iterations, {}}, factor_.get());
  solution_ = {
      {}, solution_.iterations + change.iterations, change.residual * left, change.converged, change.stop_reason};
  if (!change.converged)
    throw plate::NumericalError(fmt::format("cg: {}, residual {:.2e} above tolerance {:.1e}", change.stop_reason,
                                            solution_.residual, tolerance));
  state_ += change.state;
  plate_.constraints().impose(state_);  // what follows other points is what they say, to the last bit: as when restored
}

void QuasiStaticBonds::choose(const Equilibrium& state) {
  breaks_.clear();
  if (!state.ends) breaks_ = check_.at_least((1 - equal_demand) * most_, state_);
  auto row = row_of(state);
  row.crack_length = cracks_.length(), row.tips = cracks_.tips().size(), row.broken_bonds = double(cracks_.broken());
  record_.add(row);
  record_.cracks = cracks_.drawn();
}

void QuasiStaticBonds::advance(double factor) {
  const bool new_lines = cracks_.broke(breaks_, double(advances_));
  plate_.break_bonds(check_.here(breaks_), 1);
  const plate::State none;
  spent_ += factor * factor * plate_.carry_on_all({state_, none, 0});
  ++advances_;
  if (!new_lines) return;
  new_lines_ = true;
  cracks_.look(double(advances_), record_, double(advances_));
  record_.cracks = cracks_.drawn();
}

/// Intensity factors of the tips; none of tips beside edges, bends and other cracks.
std::optional<std::vector<post::Srif>> QuasiStaticBonds::factors(double factor) {
  if (!options_of_factors_ || !new_lines_) return std::nullopt;
  new_lines_ = false;
  plate::Forces force;
  plate_.internal_force(state_, force);
  start_.boundary().elastic_supports.take_force(state_, force);
  plate_.constraints().fetch(force);
  const auto paths = cracks_.paths();
  const auto view = plate_.tip_view();
  std::vector<post::Srif> result;
  for (const auto& [number, tip] : cracks_.tips_of_cracks()) {
    if (!plate_.here(tip.position)) continue;
    const auto methods = post::tip_methods(view, start_.problem(), paths, tip, *options_of_factors_);
    if (!methods) continue;
    for (auto& srif : (*methods)(factor * state_, factor * force, true)) {
      srif.tip = number;
      post::normalize(srif, *options_of_factors_, start_.section().thickness);
      result.push_back(std::move(srif));
    }
  }
  return of_all(start_, std::move(result));
}

plate::Mesh QuasiStaticBonds::draw(post::Frame& frame, const plate::State& state) const {
  frame.cracks = record_.cracks;
  return plate_.draw(frame, state, start_, cracks_.cuts());
}

std::vector<double> QuasiStaticBonds::lengths() const {
  std::vector<double> result;
  for (const auto& line : cracks_.lines()) result.push_back(line.length);
  return result;
}

template <typename Archive, typename Self>
void QuasiStaticBonds::memory(Archive& archive, Self& self) {
  auto& [none, iterations, residual, converged, reason] = self.solution_;
  archive(self.record_, self.warnings_, self.plate_, self.cracks_, self.most_, iterations, residual, converged, reason,
          self.breaks_, self.new_lines_, self.advances_, self.spent_);
}

void QuasiStaticBonds::save(plate::OutArchive& archive) const {
  memory(archive, *this);
}

void QuasiStaticBonds::restore(plate::InArchive& archive) {
  memory(archive, *this);
}

}  // namespace fracture
