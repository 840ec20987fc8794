#pragma once
#include <Eigen/Dense>

#include "plate/model/solver_choices.hpp"
#include "plate/solve/motion/dynamics.hpp"

namespace plate {

/// Modes that move under loads that are straight lines in time between the points of their histories: exact.
class MovingModes {
public:
  /// At rest, undeformed. `squares`: omega^2 of every mode [1/time^2]. `shares`: of the loads (columns) in the modes
  /// (rows). `loads` must outlive this.
  MovingModes(Eigen::VectorXd squares, Eigen::MatrixXd shares, const std::vector<TimedLoad>& loads,
              const Damping& damping = {});

  /// At rest under the loads of time 0, which have grown slowly.
  void rest();
  /// With these amplitudes and velocities instead, brought there by something else than the loads.
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
  /// By damping until now: what is left of the work.
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

}  // namespace plate
