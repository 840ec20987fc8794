#include "plate/solve/motion/moving_modes.hpp"

#include <algorithm>
#include <cmath>

#include "plate/model/history.hpp"
#include "plate/model/nodal_forces.hpp"

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

}  // namespace plate
