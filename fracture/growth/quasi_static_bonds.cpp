#include "fracture/growth/quasi_static_bonds.hpp"

#include <fmt/format.h>
#include <cmath>

#include "fracture/growth/archive.hpp"
#include "fracture/growth/distributed_growth.hpp"
#include "plate/formulation/pieces.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/factorised_plate.hpp"
#include "plate/solve/stretching.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/files/result_checks.hpp"

namespace fracture {
namespace {

constexpr double equal_demand = 1e-5;  // of the demand: mirror images, solved to a residual of 1e-6 or better

/// Inverses of a plate and of its plane, for stacked() forces.
class StackedInverse : public plate::Preconditioner {
public:
  StackedInverse(std::unique_ptr<plate::Preconditioner> plate, std::unique_ptr<plate::Preconditioner> membrane)
      : plate_(std::move(plate)), membrane_(std::move(membrane)) {}

  void apply(const plate::Forces& residual, plate::State& result) const override {
    plate::State bending, in_plane;
    plate_->apply(plate::of_plate(residual), bending), membrane_->apply(plate::of_plane(residual), in_plane);
    result = plate::stacked(bending, in_plane);
  }
  std::size_t bytes() const override { return plate_->bytes() + membrane_->bytes(); }

private:
  std::unique_ptr<plate::Preconditioner> plate_, membrane_;
};

}  // namespace

/// The plate in its plane, and both together.
struct QuasiStaticBonds::Membrane {
  const plate::Formulation& start;
  BondLimits limits;
  plate::StackedOperator stiffness;
  plate::Constraints constraints;
  plate::State state;

  /// `plate`: with its plane.
  Membrane(const plate::Formulation& membrane, const Growth& growth, const plate::Formulation& bent,
           const DamagedPlate& plate)
      : start(membrane),
        limits(growth, membrane.section(), membrane.discretization()),
        stiffness(plate, *plate.plane()),
        constraints(plate::stacked(bent.constraints(), membrane.constraints(), plate.points())),
        state(plate::zero_state(membrane.points())) {}
};

QuasiStaticBonds::QuasiStaticBonds(const Growth& growth, const plate::Formulation& start,
                                   std::optional<post::SrifOptions> factors, const plate::StaticOptions& options,
                                   const plate::Formulation* membrane)
    : growth_(growth),
      start_(start),
      options_of_factors_(std::move(factors)),
      options_(options),
      plate_(start, membrane, overlap_of_growth(start, options_of_factors_.has_value())),
      membrane_(membrane ? std::make_unique<Membrane>(*membrane, growth, start, plate_) : nullptr),
      limits_(growth, start.section(), start.discretization()),
      check_(growth, limits_, plate_, start.boundary(), membrane ? &membrane_->limits : nullptr),
      cracks_(start),
      load_(start.total_load()),
      state_(plate::zero_state(load_.cols())) {
  diagonal_ = plate::folded_diagonal(plate_, start.constraints());
  if (membrane) {
    load_ = plate::stacked(load_, membrane->total_load());
    diagonal_ = plate::stacked(diagonal_, plate::folded_diagonal(*plate_.plane(), membrane->constraints()));
  }
  norm_ = norm(load_);
  if (!start.may_move() && !(membrane && membrane->may_move())) {
    // the factor would enlarge the rounding of a motion without resistance
    factor_ = start.preconditioner(plate::Preconditioning::two_level).inverse;
    if (membrane)
      factor_ = std::make_unique<StackedInverse>(std::move(factor_),
                                                 membrane->preconditioner(plate::Preconditioning::two_level).inverse);
  }
  cracks_.look(0, record_, 0);
}

QuasiStaticBonds::~QuasiStaticBonds() = default;

double QuasiStaticBonds::norm(const plate::Forces& force) const {
  if (!membrane_) return plate_.norm(force, diagonal_);
  return std::hypot(plate_.norm(plate::of_plate(force), plate::of_plate(diagonal_)),
                    plate_.plane()->norm(plate::of_plane(force), plate::of_plane(diagonal_)));
}

plate::State QuasiStaticBonds::whole() const {
  return membrane_ ? plate::stacked(state_, membrane_->state) : state_;
}

/// What follows other points is what they say, to the last bit: as when restored.
void QuasiStaticBonds::set_whole(const plate::State& whole) {
  state_ = membrane_ ? plate::of_plate(whole) : whole;
  if (membrane_) membrane_->state = plate::of_plane(whole);
  restored_points();
}

void QuasiStaticBonds::restored_points() {
  plate_.constraints().impose(state_);
  if (membrane_) membrane_->start.constraints().impose(membrane_->state);
}

std::vector<plate::State*> QuasiStaticBonds::of_points() {
  return membrane_ ? std::vector{&state_, &membrane_->state} : std::vector{&state_};
}

std::optional<QuasiStaticModel::InPlane> QuasiStaticBonds::in_plane() const {
  return membrane_ ? std::optional<InPlane>({membrane_->start, plate_.plane(), membrane_->state}) : std::nullopt;
}

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
  if (membrane_) result.displacement += 2 * post::slow_work(membrane_->start, membrane_->state);
  most_ = check_.largest(whole());
  if (most_ > 0)
    result.critical = 1 / std::sqrt(most_);
  else
    result.end = End::cannot_grow;
  if (advances_ == 0 && !(membrane_ && post::moves(membrane_->state, result.displacement, membrane_->start)))
    post::require_motion(start_, {start_.total_load()}, state_, result.displacement, warnings_);
  return result;
}

std::string QuasiStaticBonds::free_pieces() const {
  std::string free;
  const auto look = [&](const std::vector<plate::Piece>& pieces, const char* where) {
    for (const auto& piece : pieces)
      if (piece.free_modes > 0)
        free += fmt::format("{}the piece of {} points about ({:g}, {:g}) is not held{}", free.empty() ? "" : "; ",
                            piece.points, piece.position.x(), piece.position.y(), where);
  };
  look(plate::pieces(start_.boundary(), plate_.families()), "");
  if (membrane_ && free.empty())
    look(plate::pieces(membrane_->start.boundary(), plate_.plane()->families(), plate::PlateLaw::membrane),
         " in the plane");
  return free;
}

/// The residual of the last state is the load of its change.
void QuasiStaticBonds::find_state() {
  const plate::Operator& stiffness = membrane_ ? membrane_->stiffness : static_cast<const plate::Operator&>(plate_);
  const auto& constraints = membrane_ ? membrane_->constraints : plate_.constraints();
  plate::State state = whole();
  plate::Forces rest;
  stiffness.internal_force(state, rest);
  rest += load_;
  const double left = norm(rest) / norm_;
  const double tolerance = std::min(options_.tolerance, 1e-6);
  if (left <= tolerance) return;
  const auto change = plate::conjugate_gradients(stiffness, constraints, rest,
                                                 {tolerance / left, options_.max_iterations, {}}, factor_.get());
  solution_ = {
      {}, solution_.iterations + change.iterations, change.residual * left, change.converged, change.stop_reason};
  if (!change.converged)
    throw plate::NumericalError(fmt::format("cg: {}, residual {:.2e} above tolerance {:.1e}", change.stop_reason,
                                            solution_.residual, tolerance));
  state += change.state;
  set_whole(state);
}

void QuasiStaticBonds::choose(const Equilibrium& state) {
  breaks_.clear();
  if (!state.ends) breaks_ = check_.at_least((1 - equal_demand) * most_, whole());
  auto row = row_of(state);
  row.crack_length = cracks_.length(), row.tips = cracks_.tips().size(), row.broken_bonds = double(cracks_.broken());
  record_.add(row);
  record_.cracks = cracks_.drawn();
}

void QuasiStaticBonds::advance(double factor) {
  const bool new_lines = cracks_.broke(breaks_, double(advances_));
  plate_.break_bonds(check_.here(breaks_), 1);
  const plate::State none, state = whole();
  spent_ += factor * factor * plate_.carry_on_all({state, none, 0});
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
  const auto found = [&](const plate::Formulation& start, const DamagedPlate& plate, const plate::State& state) {
    return of_all(start, factors_of(start, plate, cracks_.tips_of_cracks(), cracks_.paths(), *options_of_factors_,
                                    state, factor, true));
  };
  auto result = found(start_, plate_, state_);
  if (membrane_)
    post::add_membrane(result, found(membrane_->start, *plate_.plane(), membrane_->state), start_.section());
  return result;
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
