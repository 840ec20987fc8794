#pragma once
#include <Eigen/Dense>
#include <functional>
#include <utility>
#include <vector>

#include "plate/model/numerical_method.hpp"
#include "plate/model/state.hpp"

namespace plate {

class Constraints;
class Inertia;
class Operator;
class Preconditioner;

struct HarmonicOptions {
  Sweep sweep;
  Damping damping;
  double tolerance = 3e-4;  // of the answer at every frequency, root of the mean square over the mass, relative
  std::size_t max_vectors = 800;
  /// Groups of linear functionals of the state (rows, or none; columns as State::data()) that must be known as well, to
  /// the tolerance of the largest of the group at every frequency. Where a group nearly vanishes there, a hundredth of
  /// what its family has at most for so large an answer counts.
  std::vector<std::vector<Eigen::MatrixXd>> watched = {};
  std::function<void(std::size_t vectors, double change)> progress = {};
};

/// Steady-state harmonic response of a damped held plate under forces F cos(2 pi f t):
/// u = A cos(2 pi f t) - B sin(2 pi f t), with (K + i omega C - omega^2 M) (A + i B) = F, in the space of
/// load-dependent Lanczos vectors (LanczosMotion; theory.md, "Vibration").
class HarmonicResponse {
public:
  /// Every free degree of freedom must have mass. `load`: not folded; `inverse`: of K, exact or near. Throws
  /// NumericalError where the vectors do not suffice.
  HarmonicResponse(const Operator& plate, const Constraints& constraints, const Inertia& inertia, const Forces& load,
                   const Preconditioner& inverse, const HarmonicOptions& options);

  /// Frequencies of the sweep, and resonances between them [1/time].
  const std::vector<double>& frequencies() const { return frequencies_; }
  /// Resonances of the undamped plate that the load excites: with a thousandth of the response there, or more [1/time].
  const std::vector<double>& resonances() const { return resonances_; }
  /// A and B at the frequency of this number [3 x points].
  std::pair<State, State> at(std::size_t number) const;

  std::size_t vectors() const { return std::size_t(vectors_.cols()); }
  /// Change by the last vectors, at least sixteen, in the measure of the tolerance.
  double change() const { return change_; }
  /// Change by the last vectors of every watched group of every family.
  const std::vector<std::vector<double>>& watched_change() const { return watched_; }

private:
  Eigen::Index points_;
  Eigen::MatrixXd vectors_;       // columns, each a state flattened
  Eigen::MatrixXcd coordinates_;  // in them: a column for every frequency
  std::vector<double> frequencies_, resonances_;
  double change_ = 0;
  std::vector<std::vector<double>> watched_;
};

}  // namespace plate
