#include "plate/lanczos_motion.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "plate/numerical_error.hpp"
#include "plate/statics.hpp"

namespace plate {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index more_vectors = 8;  // between looks at whether they suffice

Eigen::Map<const VectorXd> flat(const State& state) {
  return {state.data(), state.size()};
}

/// States u = P q whose q are orthonormal with the mass.
class Space {
public:
  Space(const Operator& plate, const Constraints& constraints, const Inertia& inertia, const Preconditioner& inverse)
      : plate_(plate), constraints_(constraints), inertia_(inertia), inverse_(inverse), points_(Eigen::Index(plate.points())),
        vectors_(3 * points_, 0), forces_(3 * points_, 0) {}

  /// The answer to nodal forces at rest, as a new vector; false where it is in the space already.
  bool add(const Forces& load) {
    const StaticOptions options{1e-8, 10000, {}};
    const auto solution = conjugate_gradients(plate_, constraints_, load, options, &inverse_);
    if (!solution.converged) throw NumericalError("Lanczos vectors: conjugate gradients: " + solution.stop_reason);
    return add_state(solution.state);
  }

  /// The next vector of the sequence of vector `i`: what the inverse makes of it need not be exact.
  bool add_after(Index i) {
    State answer;
    inverse_.apply(inertia_(state_of(vectors_.col(i))), answer);
    constraints_.impose(answer);
    return add_state(std::move(answer));
  }

  Index size() const { return size_; }
  auto vectors() const { return vectors_.leftCols(size_); }
  /// u_i K u_j
  MatrixXd stiffness() const {
    const MatrixXd K = vectors().transpose() * forces_.leftCols(size_);
    return (K + K.transpose()) / 2;
  }

private:
  bool add_state(const State& answer) {
    VectorXd u = flat(answer);
    const double whole = norm(u);
    if (!(whole > 0)) return false;
    for (int twice = 0; twice < 2; ++twice) {  // once leaves rounding of what was taken out
      const Forces momentum = inertia_(state_of(u));
      u -= vectors_.leftCols(size_) * (vectors_.leftCols(size_).transpose() * flat(momentum));
    }
    const double rest = norm(u);
    if (!(rest > 1e-10 * whole)) return false;
    u /= rest;
    if (size_ == vectors_.cols()) {
      vectors_.conservativeResize(u.size(), size_ + more_vectors);
      forces_.conservativeResize(u.size(), size_ + more_vectors);
    }
    Forces force;
    plate_.internal_force(state_of(u), force);
    constraints_.fold(force);
    vectors_.col(size_) = u;
    forces_.col(size_) = -flat(force);
    ++size_;
    return true;
  }

  double norm(const VectorXd& u) const { return std::sqrt(u.dot(flat(inertia_(state_of(u))))); }
  State state_of(const VectorXd& u) const { return Eigen::Map<const State>(u.data(), 3, points_); }

  const Operator& plate_;
  const Constraints& constraints_;
  const Inertia& inertia_;
  const Preconditioner& inverse_;
  Index points_;
  Index size_ = 0;
  MatrixXd vectors_, forces_;  // columns
};

/// Modes that move under loads that are straight lines in time between steps: exact.
class Modes {
public:
  /// `shares`: of the loads (columns) in the modes (rows).
  Modes(VectorXd squares, MatrixXd shares, const std::vector<TimedLoad>& loads)
      : squares_(std::move(squares)), omega_(squares_.cwiseSqrt()), shares_(std::move(shares)), loads_(loads),
        y_(VectorXd::Zero(squares_.size())), v_(y_) {}

  void rest() {
    y_ = (shares_ * factors(0)).cwiseQuotient(squares_);
    work_ = squares_.dot(y_.cwiseAbs2()) / 2;
  }

  void advance(double from, double to) {
    for (const double next : corners(from, to)) step(from, next), from = next;
  }

  const VectorXd& amplitudes() const { return y_; }
  const VectorXd& velocities() const { return v_; }
  double work() const { return work_; }
  double strain_energy() const { return squares_.dot(y_.cwiseAbs2()) / 2; }
  double kinetic_energy() const { return v_.squaredNorm() / 2; }
  double potential(double time) const { return -y_.dot(shares_ * factors(time)); }

private:
  VectorXd factors(double time) const {
    VectorXd result{Index(loads_.size())};
    for (std::size_t l = 0; l < loads_.size(); ++l) result[Index(l)] = factor(loads_[l].history, time);
    return result;
  }

  /// The ends of the straight pieces of all histories within (from, to], `to` the last.
  std::vector<double> corners(double from, double to) const {
    std::vector<double> result{to};
    const auto take = [&](double time) {
      if (time > from && time < to) result.push_back(time);
    };
    for (const auto& load : loads_) {
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

  void step(double from, double to) {
    const double dt = to - from;
    const VectorXd now = factors(from), then = factors(to), slopes = (then - now) / dt;
    const VectorXd load = shares_ * now, slope = shares_ * slopes;
    VectorXd swept(y_.size());  // the integral of y
    const VectorXd before = y_;
    for (Index i = 0; i < y_.size(); ++i) {
      const double w = omega_[i], square = squares_[i], c = std::cos(w * dt), s = std::sin(w * dt);
      const double a = y_[i] - load[i] / square, b = (v_[i] - slope[i] / square) / w;
      swept[i] = (load[i] + slope[i] * dt / 2) * dt / square + (a * s + b * (1 - c)) / w;
      y_[i] = (load[i] + slope[i] * dt) / square + a * c + b * s;
      v_[i] = slope[i] / square + w * (b * c - a * s);
    }
    work_ += then.dot(shares_.transpose() * y_) - now.dot(shares_.transpose() * before) - slopes.dot(shares_.transpose() * swept);
  }

  VectorXd squares_, omega_;  // omega^2
  MatrixXd shares_;
  const std::vector<TimedLoad>& loads_;
  VectorXd y_, v_;
  double work_ = 0;
};

/// The modes of a space, as combinations (columns) of its vectors.
struct Solved {
  MatrixXd shapes;
  Modes modes;
  double largest_square;
};

Solved solved(const Space& space, const std::vector<TimedLoad>& loads, bool from_equilibrium) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(space.stiffness());
  const VectorXd& squares = eigen.eigenvalues();
  if (eigen.info() != Eigen::Success || !(squares[0] > 0)) throw NumericalError("Lanczos vectors: the stiffness is not positive");
  MatrixXd shares(space.size(), Index(loads.size()));
  for (std::size_t l = 0; l < loads.size(); ++l) shares.col(Index(l)) = space.vectors().transpose() * flat(loads[l].forces);
  Solved result{eigen.eigenvectors(), Modes(squares, eigen.eigenvectors().transpose() * shares, loads), squares.tail<1>()[0]};
  if (from_equilibrium) result.modes.rest();
  return result;
}

/// Amplitudes of the vectors of a space at some times, and the largest change from those of a smaller space, in the norm of the
/// mass and relative to the largest motion.
class Watch {
public:
  Watch(const std::vector<TimedLoad>& loads, const LanczosOptions& options) : loads_(loads), options_(options) {}

  double change(const Space& space) {
    constexpr Index looks = 100;  // however few rows are wanted
    Solved now = solved(space, loads_, options_.from_equilibrium);
    const auto time = [&](Index n) { return options_.duration * double(n) / double(looks); };
    MatrixXd found(space.size(), looks);
    for (Index n = 0; n < looks; ++n) {
      now.modes.advance(time(n), time(n + 1));
      found.col(n) = now.shapes * now.modes.amplitudes();
    }
    MatrixXd difference = found;
    difference.topRows(before_.rows()) -= before_;
    const auto largest = [](const MatrixXd& u) { return u.colwise().norm().maxCoeff(); };
    const double whole = largest(found), result = before_.size() == 0 ? 1 : whole > 0 ? largest(difference) / whole : 0;
    before_ = std::move(found);
    return result;
  }

private:
  const std::vector<TimedLoad>& loads_;
  const LanczosOptions& options_;
  MatrixXd before_;
};

/// Adds vectors until they change the motion no more.
LanczosMotion fill(Space& space, const std::vector<TimedLoad>& loads, const LanczosOptions& options) {
  LanczosMotion result;
  for (const auto& load : loads) space.add(load.forces);
  Watch watch(loads, options);
  const auto least = std::size_t(3 * more_vectors);
  for (Index next = 0;; ++next) {
    const bool exhausted = next >= space.size();
    result.vectors = std::size_t(space.size());
    if (exhausted || (result.vectors >= least && space.size() % more_vectors == 0)) {
      result.change = space.size() == 0 || exhausted ? 0 : watch.change(space);
      if (options.progress) options.progress(result.vectors, result.change);
      if (result.change <= options.tolerance) return result;
      if (result.vectors >= options.max_vectors)
        throw NumericalError(std::to_string(result.vectors) + " Lanczos vectors change the motion by " +
                             std::to_string(result.change) + " still, more than the tolerance: take a larger one, or steps");
    }
    space.add_after(next);
  }
}

}  // namespace

LanczosMotion lanczos_motion(const Operator& plate, const Constraints& constraints, const Inertia& inertia,
                             const std::vector<TimedLoad>& loads, const Preconditioner& inverse, const LanczosOptions& options,
                             const std::function<void(const Instant&)>& observe) {
  Space space(plate, constraints, inertia, inverse);
  LanczosMotion result = fill(space, loads, options);
  const auto points = Index(plate.points());
  const bool moves = space.size() > 0;
  Solved motion = moves ? solved(space, loads, options.from_equilibrium) : Solved{{}, Modes({}, MatrixXd(0, Index(loads.size())), loads), 0};
  result.largest_frequency = std::sqrt(motion.largest_square) / (2 * std::numbers::pi);
  const MatrixXd shapes = moves ? MatrixXd(space.vectors() * motion.shapes) : MatrixXd(3 * points, 0);
  // states of several rows at once: one product of matrices
  constexpr std::size_t together = 16;
  const auto time_of = [&](std::size_t row) { return options.duration * double(row) / double(options.rows); };
  for (std::size_t first = 0; first <= options.rows; first += together) {
    std::vector<Modes> at;
    MatrixXd amplitudes(space.size(), Index(std::min(together, options.rows + 1 - first)));
    for (Index i = 0; i < amplitudes.cols(); ++i) {
      const auto row = first + std::size_t(i);
      if (row > 0) motion.modes.advance(time_of(row - 1), time_of(row));
      at.push_back(motion.modes);
      amplitudes.col(i) = motion.modes.amplitudes();
    }
    const MatrixXd states = shapes * amplitudes;
    for (Index i = 0; i < states.cols(); ++i) {
      const auto& modes = at[std::size_t(i)];
      const double time = time_of(first + std::size_t(i));
      const State state = Eigen::Map<const State>(states.col(i).data(), 3, points);
      if (!state.allFinite()) throw NumericalError("the state is not finite at time " + std::to_string(time));
      const auto velocity = [&]() -> State {
        const VectorXd all = shapes * modes.velocities();
        return Eigen::Map<const State>(all.data(), 3, points);
      };
      observe({first + std::size_t(i), time, state, velocity, modes.kinetic_energy(), modes.work(), modes.strain_energy(),
               modes.kinetic_energy() + modes.potential(time)});
    }
  }
  return result;
}

}  // namespace plate
