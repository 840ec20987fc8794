#pragma once
#include <Eigen/Dense>
#include <limits>

#include "plate/model/numerical_method.hpp"
#include "plate/solve/motion/dynamics.hpp"

namespace plate {

class Inertia;
class Preconditioner;

/// Modes that move under loads that are straight lines in time between the points of their histories: exact.
class MovingModes {
public:
  /// Constructs modes at rest, undeformed. `squares`: omega^2 of every mode [1/time^2]. `shares`: of the loads
  /// (columns) in the modes (rows). `loads` must outlive this.
  MovingModes(Eigen::VectorXd squares, Eigen::MatrixXd shares, const std::vector<TimedLoad>& loads,
              const Damping& damping = {});

  /// Sets the state of rest under the loads of time 0, which have grown slowly.
  void rest();
  /// Sets amplitudes and velocities that something else than the loads has caused.
  void begin(const Eigen::VectorXd& amplitudes, const Eigen::VectorXd& velocities);
  void advance(double from, double to);

  const Eigen::VectorXd& amplitudes() const { return y_; }
  const Eigen::VectorXd& velocities() const { return v_; }
  Eigen::VectorXd accelerations(double time) const {
    return shares_ * factors(time) - squares_.cwiseProduct(y_) - drag_.cwiseProduct(v_);
  }
  double work() const { return work_; }
  double strain_energy() const { return squares_.dot(y_.cwiseAbs2()) / 2; }
  double kinetic_energy() const { return v_.squaredNorm() / 2; }
  /// Energy dissipated by damping until now: what is left of the work.
  double dissipated() const { return drag_.isZero(0) ? 0 : work_ - strain_energy() - kinetic_energy(); }
  double potential(double time) const { return -y_.dot(shares_ * factors(time)); }

private:
  Eigen::VectorXd factors(double time) const;
  std::vector<double> corners(double from, double to) const;
  void step(double from, double to);

  Eigen::VectorXd squares_, omega_;  // omega^2
  Eigen::VectorXd drag_;             // alpha + beta omega^2
  Eigen::MatrixXd shares_;
  const std::vector<TimedLoad>* loads_;
  Eigen::VectorXd y_, v_;
  double work_ = 0;
};

struct LanczosOptions {
  double duration = 0;
  double tolerance = 3e-4;  // of the motion: root of the mean square over the mass, relative to the largest
  std::size_t max_vectors = 800;
  bool from_equilibrium =
      false;  // at time 0 in equilibrium with the loads of that time, which have grown slowly; else undeformed
  /// Groups of linear functionals of the state (rows, or none; columns as State::data()) whose truncation is wanted.
  std::vector<Eigen::MatrixXd> watched = {};
  /// Tolerance of the truncation of every group, as far as eight times as many vectors as the motion needs reach it:
  /// a fit where points are few sees little but noise.
  double watched_tolerance = std::numeric_limits<double>::infinity();
  std::vector<Eigen::MatrixXd> told = {};  // likewise, but however large it is
  std::function<void(std::size_t vectors, double change)> progress = {};
  Damping damping = {};
  /// State at time 0, instead of rest: what brought the plate there counts as work. Empty: zero.
  State deflected = {}, velocity = {};
};

/// The linear motion of a held plate in the space of load-dependent Lanczos vectors K^-1 F, (K^-1 M) K^-1 F, ...
/// (Wilson, Yuan and Dickens 1982; Nour-Omid and Clough 1984; theory.md, "Dynamics"), in which every mode moves
/// exactly; there is no time step. Histories are straight between their points, a sine between 500 points a period.
class LanczosMotion {
public:
  /// Every free degree of freedom must have mass. `inverse`: of K, exact or near. `loads` must outlive this.
  /// Throws NumericalError where max_vectors leave a change() of more than ten tolerances.
  LanczosMotion(const Operator& plate, const Constraints& constraints, const Inertia& inertia,
                const std::vector<TimedLoad>& loads, const Preconditioner& inverse, const LanczosOptions& options);

  /// Evaluates the motion from time 0 on, at `rows` equal times up to the duration and at time 0; calls `see` as
  /// central_differences does, with the number of the row as its step. Throws NumericalError where a number is not
  /// finite.
  void observe(std::size_t rows, const std::function<void(const Instant&)>& see) const;

  std::size_t vectors() const { return std::size_t(shapes_.cols()); }
  /// Change by the last vectors, at least eight, in the measure of the tolerance.
  double change() const { return change_; }
  /// Estimated error of every watched group at any time, relative to the largest of its functionals: four times the
  /// largest difference from at most 0.7 times as many vectors (theory.md, "Dynamics").
  const std::vector<double>& truncated() const { return truncated_; }
  /// Estimated error of every group of LanczosOptions::told, defined as truncated().
  const std::vector<double>& truncated_told() const { return truncated_told_; }

private:
  double duration_;
  Eigen::Index points_;
  Damping damping_;
  Eigen::MatrixXd shapes_;  // of the modes: columns, each a state flattened
  MovingModes start_;
  double change_ = 0;
  std::vector<double> truncated_, truncated_told_;
};

}  // namespace plate
