#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "plate/formulation/operator.hpp"
#include "plate/model/point_map.hpp"
#include "plate/model/state.hpp"
#include "plate/solve/motion/moving_faces.hpp"

namespace plate {

class Constraints;
class Formulation;
struct TimedLoad;

/// 2 / omega with omega^2 not below the largest eigenvalue of M^-1 K: the largest value of a Lanczos iteration, which
/// comes from below, plus 1 %, or the bound of Collatz for |K|, whichever is smaller. `start` of the iteration: absent,
/// random numbers by the order of the points.
double stable_time_step(const Operator& plate, const Constraints& constraints, const Forces& mass,
                        std::optional<State> start = {});
/// Stable time step of a plate with this factor of its rotary inertia; the same for any number of ranks that share it.
double stable_time_step(const Formulation& plate, double rotary);
/// Numbers by the places of the points; absent where one process holds the whole plate.
std::optional<State> start_by_place(const Formulation& plate);

/// Mass per degree of freedom, held or not, of a plate whose supports move; nothing of others.
Forces driven_mass(const Formulation& plate, double rotary);

/// A mass that meets the plate at time 0 at a place of it, and presses on it by a spring that does not pull.
struct Impactor {
  std::vector<std::pair<Dof, double>> terms;  // w of the place: degrees of freedom and their factors
  double mass = 0;                            // [mass]
  double velocity = 0;                        // along w [length/time]; its sign tells the side
  double stiffness = 0;                       // of the contact [force/length]
  const PointMap* map = nullptr;              // of the plate, which must outlive this; null: one process
};

/// State of the impacting mass: place along w, velocity half a step before, and the contact so far.
struct ImpactorState {
  double place = 0, velocity = 0;
  double largest = 0, touching = 0;  // force, with its sign [force]; for how long [time]
};

/// Motion and contact force of the impacting mass at an instant.
struct ImpactorMotion {
  double place, velocity;                     // along w [length, length/time]
  double force;                               // that it presses with, on the plate along w [force]
  double largest, touching;                   // of all steps so far: force, how long it presses [time]
  std::vector<std::pair<Dof, double>> terms;  // of the Impactor
};

/// Initial state of a motion, beside loads: what its case gives, on all of its points.
struct BeginOfMotion {
  State deflected = {}, velocity = {};  // empty: zero
  std::optional<Impactor> impact = {};
  double given = 0;  // strain and kinetic energy of it [energy]
};

/// Data of one step that the observer of a dynamic run receives.
struct Instant {
  std::size_t step;
  double time;
  const State& state;
  std::function<State()> velocity;  // of this step; computed when asked for
  double kinetic_energy;
  double external_work;
  double strain_energy;
  /// v(n-1/2) M v(n+1/2) / 2: with the strain energy, what central differences change by the work of the loads alone.
  double discrete_kinetic_energy = 0;
  double potential = 0;                      // of the loads: -f u
  std::function<State()> acceleration = {};  // as velocity; none in statics
  /// Internal force on what is held (Constraints::on_held()), where it is at hand.
  std::optional<Eigen::VectorXd> held_force = {};
  bool interrupted = false;  // a signal ends the motion after it
  double dissipated = 0;     // by damping and by faces of cracks that meet, until then [energy]
  /// The state to which the stiffness answers: u + beta v; where it does not damp, none.
  std::function<State()> strained = {};
  std::optional<ImpactorMotion> contact_force = {};
  /// State less a motion as one rigid body, in statics (StaticResult); none where it is the state.
  const State* rest = nullptr;
  /// Forces beside the loads: of the stretched middle plane on the deflections; none where it is null.
  const Forces* stretched = nullptr;
  /// Contact of the pairs of points on cracks, and its part of `dissipated`; null where there are none.
  const std::vector<PairContact>* faces = nullptr;
  ContactSoFar contact_so_far = {};
  const State& what_strains() const { return rest ? *rest : state; }
};

/// A step of a motion, as those who change the plate see it. Before the force they may change state and velocity too.
struct Step {
  std::size_t step;
  double time, time_step;
  State& state;
  State& velocity;  // half a step before
};

/// Changes a plate while it moves. Called in every step.
class Changes {
public:
  virtual ~Changes() = default;
  virtual void before_force(const Step& now) = 0;
  /// `force`: the internal force, carried over to the free degrees of freedom.
  virtual void after_force(const Step& now, const Forces& force) = 0;
};

/// Checkpoint of a motion between two steps, with the states of owned points; empty at rest.
struct MotionCheckpoint {
  std::size_t step = 0;
  State state, velocity;                             // velocity: half a step before
  std::vector<std::pair<double, double>> loads;      // of every load: F . u and factor when its work was last counted
  std::vector<double> work, before;                  // of every load [energy]
  std::vector<double> driven = {}, travelling = {};  // of supports that move, of loads that do
  double given = 0;                                  // what else began the motion [energy]
  State earlier = {};                                // of the step before, where the stiffness damps
  State relaxing = {}, relaxing_force = {};          // where its force relaxes: by what it strains, and folded
  double dissipated = 0;
  ImpactorState impactor_state = {};
  ContactMemory contact = {};

  /// Archives what all ranks know: not state, velocity, earlier and what relaxes, whose values go with the points.
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(step, loads, work, before, driven, travelling, given, dissipated);
    archive(impactor_state.place, impactor_state.velocity, impactor_state.largest, impactor_state.touching);
    archive(contact.so_far.least_opening, contact.so_far.lost, contact.held, contact.closed);
  }
};

struct DynamicOptions {
  double time_step = 0;
  std::size_t steps = 0;
  std::size_t observe_every = 1;
  /// Internal forces in single precision, where the plate's own are not wanted; displacements stay in double.
  std::function<void(const Values<float>&, Values<float>&)> single = {};
  /// Changes of the plate, in double precision only.
  Changes* changes = nullptr;
  bool held_forces = false;        // for those who observe
  Forces unconstrained_mass = {};  // driven_mass()
  /// State of rest at time 0, under loads that have grown slowly: their work until then counts. Empty: zero.
  State start = {};
  bool bent = false;    // something else than the loads has brought the plate there
  State velocity = {};  // at time 0, what is held at rest; empty: at rest
  double given = 0;     // what it took to begin with, beside the work of the loads [energy]
  /// alpha and beta of a damping, in double precision, of plates that do not change [1/time, time].
  double mass_damping = 0, stiffness_damping = 0;
  double relaxation = 0;  // of the force of stiffness_damping [time], where no support moves; 0: none (theory (84a))
  std::optional<Impactor> impact = {};  // likewise
  std::vector<char> own = {};           // owned points; empty: all
  /// Checkpoint from which the motion continues, with the numbers that it would have had; none: it begins at time 0.
  const MotionCheckpoint* from = nullptr;
  /// Predicate called before every step, in a distributed plate at every row: true where a checkpoint is to be saved
  /// now. A checkpoint is saved, too, before a signal ends the motion.
  std::function<bool()> due = {};
  std::function<void(const MotionCheckpoint&)> save = {};
  /// Strain energy of a state of a plate whose forces are not linear in it; absent: half their work.
  std::function<double(const State&)> strain_energy = {};
  /// Faces of cracks, which do not overlap; in double precision only.
  MovingPairs faces = {};
};

/// Central differences (Dai 21-23) from rest, undeformed or not, started with half a step's acceleration: u(dt) = a
/// dt^2 / 2. Calls `observe` at step 0, every `observe_every` steps and at the end. Throws NumericalError where a
/// displacement that is observed is not finite, with step, time and point, and Interrupted where a signal asks for the
/// end, once the step in hand has been observed.
void central_differences(const Operator& plate, const Constraints& constraints, Forces mass,
                         const std::vector<TimedLoad>& loads, const DynamicOptions& options,
                         const std::function<void(const Instant&)>& observe);

}  // namespace plate
