#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plate/formulation/operator.hpp"
#include "plate/model/numerical_method.hpp"
#include "plate/model/supports.hpp"

namespace plate {

class Constraints;
class Formulation;
class PushingSupports;
struct Analysis;

/// Tolerance of a static solution. The residual is |r| / |load| with |r|^2 = sum r_i^2 / K_ii over the free degrees of
/// freedom (K_ii of P^T diag(K) P): forces and couples count by the displacement that they cause, whatever the units.
struct StaticOptions {
  double tolerance = 1e-6;
  std::size_t max_iterations = 200000;
  std::function<void(std::size_t iteration, double residual)> progress;  // now and then
  std::optional<State> start_of_bound = {};  // of relaxation: where its bound of frequencies is sought from
};

struct StaticSolution {
  State state;
  std::size_t iterations = 0;
  double residual = 0;
  bool converged = false;
  std::string stop_reason;
};

/// Adaptive dynamic relaxation (Dai 14-20; Underwood 1983): time step 1, fictitious mass from a bound on
/// the row sums, damping from the lowest frequency that the motion shows.
/// Throws NumericalError where a number is not finite.
StaticSolution adaptive_dynamic_relaxation(const Operator& plate, const Constraints& constraints, const Forces& load,
                                           const StaticOptions& options);

/// Conjugate gradients on the same operator, preconditioned by its diagonal or by what is given. `start`: where they
/// begin, nothing elsewhere.
/// Throws NumericalError where a number is not finite or the stiffness turns out not to be positive.
StaticSolution conjugate_gradients(const Operator& plate, const Constraints& constraints, const Forces& load,
                                   const StaticOptions& options, const Preconditioner* preconditioner = nullptr,
                                   const State* start = nullptr);

/// Conjugate gradients for the stiffness K + diag(shift), shift >= 0 and zero at held degrees of freedom [3 x points].
StaticSolution conjugate_gradients(const Operator& plate, const Constraints& constraints, const Forces& shift,
                                   const Forces& load, const StaticOptions& options,
                                   const Preconditioner* preconditioner = nullptr);

/// The solution by an exact inverse, improved until it is good enough; of any stiffness, symmetric or not.
/// Throws NumericalError where a number is not finite.
StaticSolution refined(const Operator& plate, const Constraints& constraints, const Forces& load,
                       const StaticOptions& options, const Preconditioner& inverse);

/// The equilibrium of a plate, and how it was found.
struct StaticResult {
  StaticSolution solution;
  std::string method;                         // as in case files
  std::optional<std::string> preconditioner;  // of conjugate gradients
  std::size_t factor_bytes = 0;
  /// The state less a motion of the whole plate with its supports, as one rigid body: what strains it, to more digits
  /// than the state has. Without columns where it is the state.
  State strained = no_state();
  std::optional<LiftedSupports> lifted = {};  // where supports only push
  const State& what_strains() const { return strained.cols() > 0 ? strained : solution.state; }
};

/// Solves for one load by a method, and with a preconditioner for conjugate gradients. `lift`: of supports that have
/// moved; without columns none. Throws NumericalError as the solvers do.
StaticResult solve_static(const Formulation& plate, const Forces& load, StaticMethod method, Preconditioning wanted,
                          const StaticOptions& options, const State& lift = no_state());

/// Solves under all loads, by the method and with the preconditioner of an analysis.
StaticResult static_solution(const Formulation& plate, const Analysis& analysis, const StaticOptions& options);

/// State of rest under the loads of time 0; nothing where these are none. Throws NumericalError.
State start_of(const Formulation& plate, const Analysis& analysis);

/// Best affordable approximation to the inverse of a held plate for many loads: its factor, or, where it has many
/// points, its coarser plates (multigrid). `plate` must outlive it.
std::unique_ptr<Preconditioner> inverse_of(const Formulation& plate);

/// Equilibria of one plate, which must outlive this, under one load after the other: the factor or the preconditioner
/// is made once, and conjugate gradients begin at that sum of their earlier solutions whose energy is least. With
/// unilateral foundations, plates with given contact are solved until the contact is what is pressed. The gaps of
/// supports that only push are found first, and then prescribed.
class StaticSolver {
public:
  StaticSolver(const Formulation& plate, StaticMethod method, Preconditioning wanted);
  ~StaticSolver();
  StaticSolver(const StaticSolver&) = delete;

  /// `again`: what is found helps with later loads; it is stored, six numbers per point. `lift`: of supports that have
  /// moved; without columns none. Throws NumericalError as the solvers do.
  StaticResult operator()(const Forces& load, const StaticOptions& options, bool again = false,
                          const State& lift = no_state());

private:
  /// `plate`: the plate, or what is linear in its place.
  StaticResult solved(const Operator& plate, const Forces& load, const StaticOptions& options, bool again,
                      const State* start = nullptr);
  /// Solves as solved() does where supports have moved, and improves the state until it is good enough beside the
  /// reactions.
  StaticResult lifted(const Operator& plate, const Forces& load, const StaticOptions& options, bool again,
                      const State& lift, const State* start = nullptr);
  StaticResult in_contact(const Forces& load, const StaticOptions& options, const State& lift);
  StaticResult pushed(const Forces& load, const StaticOptions& options, const State& lift);

  const Formulation* plate_;
  StaticMethod method_;
  std::unique_ptr<Preconditioner> inverse_;
  std::unique_ptr<PushingSupports> pushing_;  // null where all supports hold
  std::optional<std::string> name_;
  std::vector<State> states_;
  std::vector<Forces> forces_;  // internal, folded, of every state
};

/// The sum of states whose energy is least under a load; nothing without states. `forces`: internal, of each. Forces
/// and load are folded where points follow others.
std::optional<State> nearest(const std::vector<State>& states, const std::vector<Forces>& forces, const Forces& load,
                             const Constraints& constraints);

}  // namespace plate
