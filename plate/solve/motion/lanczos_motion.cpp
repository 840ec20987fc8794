#include "plate/solve/motion/lanczos_motion.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <string>

#include "plate/model/dense_algebra.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/space.hpp"
#include "plate/solve/interruption.hpp"
#include "plate/solve/motion/lanczos_space.hpp"
#include "plate/solve/validation.hpp"

namespace plate {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// y = a c(t) + b s(t) of y'' + drag y' + square y = 0 with y(0) = a, y'(0) = b, and its velocity
/// (theory (86)); exponentials that do not overflow, whatever the damping.
std::array<double, 2> oscillated(double a, double b, double omega, double drag, double t) {
  const double decay = drag / 2, square = omega * omega, rest = square - decay * decay;
  double c, s;  // s: sin(w t) / w and its like
  if (const double w = std::sqrt(std::abs(rest)); w * t < 1e-6)
    c = std::exp(-decay * t), s = c * t;
  else if (rest > 0)
    c = std::exp(-decay * t) * std::cos(w * t), s = std::exp(-decay * t) * std::sin(w * t) / w;
  else {
    const double slow = std::exp(-square / (decay + w) * t), fast = std::exp(-(decay + w) * t);
    c = (slow + fast) / 2, s = (slow - fast) / (2 * w);
  }
  return {a * c + (b + decay * a) * s, b * c - (square * a + decay * b) * s};
}

}  // namespace

MovingModes::MovingModes(VectorXd squares, MatrixXd shares, const std::vector<TimedLoad>& loads, const Damping& damping)
    : squares_(std::move(squares)),
      omega_(squares_.cwiseSqrt()),
      drag_(VectorXd::Constant(squares_.size(), damping.mass) + damping.stiffness * squares_),
      shares_(std::move(shares)),
      loads_(&loads),
      y_(VectorXd::Zero(squares_.size())),
      v_(y_) {}

void MovingModes::rest() {
  y_ = (shares_ * factors(0)).cwiseQuotient(squares_);
  work_ = squares_.dot(y_.cwiseAbs2()) / 2;
}

void MovingModes::begin(const VectorXd& amplitudes, const VectorXd& velocities) {
  y_ = amplitudes, v_ = velocities;
  work_ = strain_energy() + kinetic_energy();
}

void MovingModes::advance(double from, double to) {
  for (const double next : corners(from, to)) step(from, next), from = next;
}

VectorXd MovingModes::factors(double time) const {
  VectorXd result{Index(loads_->size())};
  for (std::size_t l = 0; l < loads_->size(); ++l) result[Index(l)] = factor((*loads_)[l].history, time);
  return result;
}

/// The ends of the straight pieces of all histories within (from, to], `to` the last.
std::vector<double> MovingModes::corners(double from, double to) const {
  std::vector<double> result{to};
  const auto take = [&](double time) {
    if (time > from && time < to) result.push_back(time);
  };
  for (const auto& load : *loads_) {
    const History& history = load.history;
    if (history.kind == History::Kind::ramp) take(history.rise_time);
    if (history.kind == History::Kind::table)
      for (const auto& [time, value] : history.table) take(time);
    if (history.kind != History::Kind::sine) continue;
    const double piece = 1 / (500 * history.frequency);
    for (double n = std::floor(from / piece) + 1; n * piece < to; ++n) take(n * piece);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

void MovingModes::step(double from, double to) {
  const double dt = to - from;
  const VectorXd now = factors(from), then = factors(to), slopes = (then - now) / dt;
  const VectorXd load = shares_ * now, slope = shares_ * slopes;
  VectorXd swept(y_.size());  // the integral of y
  const VectorXd before = y_;
  for (Index i = 0; i < y_.size(); ++i) {
    const double w = omega_[i], square = squares_[i];
    if (const double drag = drag_[i]; drag > 0) {
      const double a = y_[i], b = v_[i], lag = drag * slope[i] / (square * square);
      const auto [y, v] = oscillated(a - load[i] / square + lag, b - slope[i] / square, w, drag, dt);
      y_[i] = (load[i] + slope[i] * dt) / square - lag + y, v_[i] = slope[i] / square + v;
      swept[i] = ((load[i] + slope[i] * dt / 2) * dt - (v_[i] - b) - drag * (y_[i] - a)) / square;
      continue;
    }
    const double c = std::cos(w * dt), s = std::sin(w * dt);
    const double a = y_[i] - load[i] / square, b = (v_[i] - slope[i] / square) / w;
    swept[i] = (load[i] + slope[i] * dt / 2) * dt / square + (a * s + b * (1 - c)) / w;
    y_[i] = (load[i] + slope[i] * dt) / square + a * c + b * s;
    v_[i] = slope[i] / square + w * (b * c - a * s);
  }
  work_ += then.dot(shares_.transpose() * y_) - now.dot(shares_.transpose() * before) -
           slopes.dot(shares_.transpose() * swept);
}

namespace {

/// Number of vectors to add between checks of whether they suffice: as many as are worth a check, whose time grows with
/// their third power.
Index more_vectors(Index vectors) {
  return std::max<Index>(8, vectors / 64 * 8);
}

/// The modes of a space, as combinations (columns) of its vectors.
struct Solved {
  MatrixXd shapes;
  MovingModes modes;
};

Solved solved(LanczosSpace& space, const std::vector<TimedLoad>& loads, const LanczosOptions& options) {
  if (space.size() == 0) return {{}, MovingModes({}, MatrixXd(0, Index(loads.size())), loads)};
  const Eigenpairs eigen = eigenpairs(space.stiffness());
  const VectorXd& squares = eigen.values;
  if (!eigen.found || !(squares[0] > 0)) throw NumericalError("Lanczos vectors: the stiffness is not positive");
  MatrixXd shares(space.size(), Index(loads.size()));
  for (std::size_t l = 0; l < loads.size(); ++l)
    shares.col(Index(l)) = space.vectors().transpose() * flat(loads[l].forces);
  Solved result{eigen.vectors, MovingModes(squares, eigen.vectors.transpose() * shares, loads, options.damping)};
  if (options.from_equilibrium) result.modes.rest();
  if (options.deflected.size() > 0 || options.velocity.size() > 0) {
    const auto in_modes = [&](const State& state) -> VectorXd {
      return state.size() > 0 ? VectorXd(eigen.vectors.transpose() * space.coordinates(state))
                              : VectorXd::Zero(squares.size());
    };
    const VectorXd at = result.modes.amplitudes(), moves = result.modes.velocities();
    result.modes.begin(at + in_modes(options.deflected), moves + in_modes(options.velocity));
  }
  return result;
}

/// Change of the wanted quantities with more vectors.
struct Change {
  double motion;                      // in the norm of the mass, relative to the largest
  std::vector<double> watched, told;  // LanczosMotion::truncated(), truncated_told()
};

/// The motion in growing spaces, at some times.
class Watch {
public:
  Watch(const std::vector<TimedLoad>& loads, const LanczosOptions& options) : loads_(loads), options_(options) {}

  Change look(LanczosSpace& space) {
    constexpr Index times = 100;  // however few rows are wanted
    Solved now = solved(space, loads_, options_);
    const auto time = [&](Index n) { return options_.duration * double(n) / double(times); };
    MatrixXd found(space.size(), times);
    for (Index n = 0; n < times; ++n) {
      now.modes.advance(time(n), time(n + 1));
      found.col(n) = now.shapes * now.modes.amplitudes();
    }
    MatrixXd difference = found;
    if (before_.size() > 0) difference.topRows(before_.rows()) -= before_;
    Change result{
        before_.size() == 0 ? 1 : share(difference.colwise().norm().maxCoeff(), found.colwise().norm().maxCoeff()),
        {},
        {}};
    before_ = std::move(found);
    result.watched = truncated(space, options_.watched, watched_);
    result.told = truncated(space, options_.told, told_);
    return result;
  }

private:
  static double share(double part, double whole) { return whole > 0 ? part / whole : 0; }

  struct EarlierValues {
    Index vectors;
    std::vector<MatrixXd> values;  // of every group
  };

  std::vector<double> truncated(const LanczosSpace& space, const std::vector<MatrixXd>& groups,
                                std::vector<EarlierValues>& earlier) {
    constexpr double fewer = 0.7, safety = 4;
    EarlierValues now{space.size(), {}};
    for (const auto& group : groups)
      now.values.push_back(group.rows() > 0 ? MatrixXd(group * space.vectors() * before_) : MatrixXd::Zero(1, 1));
    const auto other = std::find_if(earlier.rbegin(), earlier.rend(), [&](const EarlierValues& look) {
      return double(look.vectors) <= fewer * double(now.vectors);
    });
    std::vector<double> result(groups.size(), std::numeric_limits<double>::infinity());
    for (std::size_t g = 0; g < result.size() && other != earlier.rend(); ++g)
      result[g] =
          safety * share((now.values[g] - other->values[g]).cwiseAbs().maxCoeff(), now.values[g].cwiseAbs().maxCoeff());
    earlier.push_back(std::move(now));
    return result;
  }

  const std::vector<TimedLoad>& loads_;
  const LanczosOptions& options_;
  MatrixXd before_;  // amplitudes of the vectors
  std::vector<EarlierValues> watched_, told_;
};

/// Adds vectors until they change the motion, and what is watched, no more.
Change fill(LanczosSpace& space, const std::vector<TimedLoad>& loads, const LanczosOptions& options) {
  for (const auto& load : loads) space.add(load.forces);
  for (const auto* state : {&options.deflected, &options.velocity})
    if (state->size() > 0) space.add_state(*state);
  Watch watch(loads, options);
  constexpr Index least = 24;
  Index most = 0;  // for what is watched
  for (Index next = 0, look = 8;; ++next) {
    const bool exhausted = next >= space.size();
    if (exhausted)
      return {0, std::vector<double>(options.watched.size(), 0), std::vector<double>(options.told.size(), 0)};
    if (space.size() >= look) {
      look = space.size() + more_vectors(space.size());
      Change change = watch.look(space);
      if (options.progress) options.progress(std::size_t(space.size()), change.motion);
      const double worst = change.watched.empty() ? 0 : *std::ranges::max_element(change.watched);
      if (space.size() >= least && change.motion <= options.tolerance) {
        if (most == 0) most = std::min(8 * space.size(), Index(options.max_vectors));
        if (std::isfinite(worst) && (worst <= options.watched_tolerance || space.size() >= most)) return change;
      }
      // forces at a point that begin at once have a spectrum without end: what is told of its change, not refused
      constexpr double near = 10;
      const bool all = std::size_t(space.size()) >= options.max_vectors;
      if (all && change.motion <= near * options.tolerance) return change;
      if (all)
        throw NumericalError(std::to_string(space.size()) + " Lanczos vectors change the motion by " +
                             std::to_string(change.motion) +
                             " still, more than the tolerance: take a larger one, or steps");
    }
    space.add_after(next);
  }
}

}  // namespace

LanczosMotion::LanczosMotion(const Operator& plate, const Constraints& constraints, const Inertia& inertia,
                             const std::vector<TimedLoad>& loads, const Preconditioner& inverse,
                             const LanczosOptions& options)
    : duration_(options.duration), points_(Index(plate.points())), damping_(options.damping), start_({}, {}, loads) {
  LanczosSpace space(plate, constraints, inertia, inverse);
  auto change = fill(space, loads, options);
  change_ = change.motion, truncated_ = std::move(change.watched), truncated_told_ = std::move(change.told);
  Solved motion = solved(space, loads, options);
  shapes_ = space.size() > 0 ? MatrixXd(space.vectors() * motion.shapes) : MatrixXd(unknowns_per_point * points_, 0);
  start_ = std::move(motion.modes);
}

void LanczosMotion::observe(std::size_t rows, const std::function<void(const Instant&)>& see) const {
  constexpr std::size_t together = 16;  // states of several rows are one product of matrices
  const auto time_of = [&](std::size_t row) { return duration_ * double(row) / double(rows); };
  MovingModes modes = start_;
  for (std::size_t first = 0; first <= rows; first += together) {
    std::vector<MovingModes> at;
    MatrixXd amplitudes(shapes_.cols(), Index(std::min(together, rows + 1 - first)));
    for (Index i = 0; i < amplitudes.cols(); ++i) {
      const auto row = first + std::size_t(i);
      if (row > 0) modes.advance(time_of(row - 1), time_of(row));
      at.push_back(modes);
      amplitudes.col(i) = modes.amplitudes();
    }
    const MatrixXd states = shapes_ * amplitudes;
    MatrixXd accelerations(states.rows(), 0);  // of the same rows, once one is asked for
    const auto accelerate = [&] {
      for (Index i = 0; i < amplitudes.cols(); ++i)
        amplitudes.col(i) = at[std::size_t(i)].accelerations(time_of(first + std::size_t(i)));
      accelerations = shapes_ * amplitudes;
    };
    for (Index i = 0; i < states.cols(); ++i) {
      stop_if_asked("a motion by Lanczos vectors");
      const auto& then = at[std::size_t(i)];
      const double time = time_of(first + std::size_t(i));
      const auto column = [&](const MatrixXd& all) -> State {
        return Eigen::Map<const State>(all.col(i).data(), unknowns_per_point, points_);
      };
      const State state = column(states);
      require_finite(state, fmt::format("at time {:g}", time));
      const auto combined = [&](const VectorXd& of_modes) -> State {
        const VectorXd all = shapes_ * of_modes;
        return Eigen::Map<const State>(all.data(), unknowns_per_point, points_);
      };
      const auto velocity = [&] { return combined(then.velocities()); };
      const auto acceleration = [&] {
        if (accelerations.cols() == 0) accelerate();
        return column(accelerations);
      };
      Instant now{first + std::size_t(i),
                  time,
                  state,
                  velocity,
                  then.kinetic_energy(),
                  then.work(),
                  then.strain_energy(),
                  then.kinetic_energy(),
                  then.potential(time),
                  acceleration};
      now.dissipated = then.dissipated();
      if (damping_.stiffness > 0)
        now.strained = [&] { return combined(then.amplitudes() + damping_.stiffness * then.velocities()); };
      see(now);
    }
  }
}

}  // namespace plate
