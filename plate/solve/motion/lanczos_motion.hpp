#pragma once
#include <limits>

#include "plate/solve/motion/moving_modes.hpp"

namespace plate {

class Inertia;
class Preconditioner;

struct LanczosOptions {
  double duration = 0;
  double tolerance = 3e-4;  // of the motion: root of the mean square over the mass, relative to the largest
  std::size_t max_vectors = 800;
  bool from_equilibrium =
      false;  // at time 0 in equilibrium with the loads of that time, which have grown slowly; else undeformed
  /// Groups of linear functionals of the state (rows, or none; columns as State::data()) whose truncation is wanted.
  std::vector<Eigen::MatrixXd> watched = {};
  /// Of the truncation of every group, as far as four times as many vectors as the motion needs reach it: a fit where
  /// points are few sees little but noise.
  double watched_tolerance = std::numeric_limits<double>::infinity();
  std::vector<Eigen::MatrixXd> told = {};  // likewise, but however large it is
  std::function<void(std::size_t vectors, double change)> progress = {};
  Damping damping = {};
  /// At time 0, instead of at rest: what brought the plate there counts as work. Empty: zero.
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

  /// From time 0 on, at `rows` equal times up to the duration and at time 0; calls `see` as central_differences does,
  /// with the number of the row as its step. Throws NumericalError where a number is not finite.
  void observe(std::size_t rows, const std::function<void(const Instant&)>& see) const;

  std::size_t vectors() const { return std::size_t(shapes_.cols()); }
  /// By the last vectors, at least eight, in the measure of the tolerance.
  double change() const { return change_; }
  /// Estimated error of every watched group at any time, relative to the largest of its functionals: four times the
  /// largest difference from at most 0.7 times as many vectors (theory.md, "Dynamics").
  const std::vector<double>& truncated() const { return truncated_; }
  /// The same of every group of LanczosOptions::told.
  const std::vector<double>& truncated_told() const { return truncated_told_; }
  /// That the vectors hold [1/time].
  double largest_frequency() const { return largest_frequency_; }

private:
  double duration_;
  Eigen::Index points_;
  Damping damping_;
  Eigen::MatrixXd shapes_;  // of the modes: columns, each a state flattened
  MovingModes start_;
  double change_ = 0, largest_frequency_ = 0;
  std::vector<double> truncated_, truncated_told_;
};

}  // namespace plate
