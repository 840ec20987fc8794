#pragma once
#include <Eigen/Dense>

#include "plate/solve/motion/dynamics.hpp"

namespace plate {

/// Modes that move under loads that are straight lines in time between the points of their histories: exact.
class MovingModes {
public:
  /// At rest, undeformed. `squares`: omega^2 of every mode [1/time^2]. `shares`: of the loads (columns) in the modes
  /// (rows). `loads` must outlive this.
  MovingModes(Eigen::VectorXd squares, Eigen::MatrixXd shares, const std::vector<TimedLoad>& loads);

  /// At rest under the loads of time 0, which have grown slowly.
  void rest();
  void advance(double from, double to);

  const Eigen::VectorXd& amplitudes() const { return y_; }
  const Eigen::VectorXd& velocities() const { return v_; }
  Eigen::VectorXd accelerations(double time) const { return shares_ * factors(time) - squares_.cwiseProduct(y_); }
  double work() const { return work_; }
  double strain_energy() const { return squares_.dot(y_.cwiseAbs2()) / 2; }
  double kinetic_energy() const { return v_.squaredNorm() / 2; }
  double potential(double time) const { return -y_.dot(shares_ * factors(time)); }

private:
  Eigen::VectorXd factors(double time) const;
  std::vector<double> corners(double from, double to) const;
  void step(double from, double to);

  Eigen::VectorXd squares_, omega_;  // omega^2
  Eigen::MatrixXd shares_;
  const std::vector<TimedLoad>* loads_;
  Eigen::VectorXd y_, v_;
  double work_ = 0;
};

}  // namespace plate
