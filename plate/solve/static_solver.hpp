#pragma once
#include <vector>

#include "plate/solve/solution.hpp"

namespace plate {

class Preconditioner;

/// Equilibria of one plate, which must outlive this, under one load after the other: the factor or the preconditioner
/// is made once, and conjugate gradients begin at that sum of their earlier solutions whose energy is least. Where soil
/// lifts off, plates with soil that touches or does not are solved until what touches is what is pressed.
class StaticSolver {
public:
  StaticSolver(const Formulation& plate, StaticMethod method, Preconditioning wanted);
  ~StaticSolver();
  StaticSolver(const StaticSolver&) = delete;

  /// `again`: what is found helps with later loads; it is kept, six numbers per point. `lift`: of supports that have
  /// moved; without columns none. Throws NumericalError as the solvers do.
  StaticResult operator()(const Forces& load, const StaticOptions& options, bool again = false,
                          const State& lift = State(3, 0));

private:
  /// `plate`: the plate, or what is linear in its place.
  StaticResult solved(const Operator& plate, const Forces& load, const StaticOptions& options, bool again,
                      const State* start = nullptr);
  StaticResult in_contact(const Forces& load, const StaticOptions& options);

  const Formulation* plate_;
  StaticMethod method_;
  std::unique_ptr<Preconditioner> inverse_;
  std::optional<std::string> name_;
  std::vector<State> states_;
  std::vector<Forces> forces_;  // internal, folded, of every state
};

/// The sum of states whose energy is least under a load; nothing without states. `forces`: internal, of each. Forces
/// and load are folded where points follow others.
std::optional<State> nearest(const std::vector<State>& states, const std::vector<Forces>& forces, const Forces& load);

}  // namespace plate
