#pragma once
#include <functional>

#include "fracture/growth/growth.hpp"
#include "fracture/growth/record.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/solve/archive_types.hpp"
#include "plate/solve/statics.hpp"
#include "post/factors/srif.hpp"
#include "post/files/frame.hpp"

namespace plate {
class Constraints;
}

namespace fracture {

/// A plate in equilibrium with the whole load, as far as it has grown.
struct Loaded {
  std::string split;            // what is not held any more, and nothing could be solved; empty: all is held
  double displacement = 0;      // sum of loads times displacements, of supports that move too [energy]
  double critical = 0;          // load factor of the next advance; infinite where none comes
  std::optional<End> end = {};  // what ends the growth whatever the load
  double held = 0;              // of the displacement, what is of supports that move
  double error = 0;             // estimated, of `critical`, relative to it; infinite where not known
  std::string unresolved = {};  // why the next advance is not known; empty: it is
};

/// Equilibrium on the path, just before bonds break or tips advance.
struct Equilibrium {
  std::size_t advance;  // number of it; the first state is 0
  double factor, displacement,
      critical;  // of the load; of the state; load factor of the next advance, infinite where none comes
  bool stable;   // no load that was reached before would have been enough
  bool ends;     // nothing gives way any more
  Ledger ledger;
  double critical_error = 0;  // estimated, of `critical`, relative to it; infinite where not known
};

/// A row of growth.csv with what all models know of an equilibrium.
GrowthRow row_of(const Equilibrium& state);

/// Model of quasi-static growth: by tips of cracks, or by bonds that break one by one.
class QuasiStaticModel {
public:
  virtual ~QuasiStaticModel() = default;

  /// The plate as far as it has grown, solved anew. Throws plate::NumericalError.
  virtual Loaded solve() = 0;
  /// Chooses what gives way next under the load of a state, nothing where the growth ends there, and records it.
  virtual void choose(const Equilibrium& state) = 0;
  /// Lets it give way.
  virtual void advance(double factor) = 0;
  /// Reason why the last advance was not made; empty: it was.
  virtual std::string stuck() const { return {}; }

  virtual std::size_t advances() const = 0;
  virtual double fracture_energy() const = 0;  // taken so far
  virtual bool longest() const = 0;            // have cracks the largest length that was asked for?

  // What is seen of it.
  virtual const plate::Formulation& plate() const = 0;  // of the last solution
  virtual const plate::State& state() const = 0;        // of it, under the whole load
  virtual const plate::Constraints& constraints() const { return plate().constraints(); }
  virtual const plate::Operator& forces() const { return plate(); }  // as it is now
  virtual const plate::StaticSolution& solution() const = 0;         // how it was found, without its state
  /// Amount by which strain energy and work exceed those without temperatures (plate::stored()), of the last solution
  /// times a load factor [energy].
  virtual double heated(double) const { return 0; }
  /// Intensity factors under a share of the load; none where they have not been found anew.
  virtual std::optional<std::vector<post::Srif>> factors(double factor) = 0;
  /// The cells between points that are whole, and what the frame shows beside the state.
  virtual plate::Mesh draw(post::Frame& frame, const plate::State& state) const = 0;
  virtual std::vector<double> lengths() const = 0;
  virtual std::optional<std::size_t> broken_bonds() const { return std::nullopt; }
  /// Record of all equilibria, with the cracks as they are now.
  virtual const Record& record() { return record_; }
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Saves the state to continue from at an equilibrium, between choose() and advance().
  virtual void save(plate::OutArchive& archive) const = 0;
  /// Restores the state of a model that has not been solved yet. Throws plate::NumericalError.
  virtual void restore(plate::InArchive& archive) = 0;
  /// Values of points to be saved beside save(): each rank saves its own. Null where there are none.
  virtual plate::State* of_points() { return nullptr; }
  /// Computes the values of all other points, after those of owned points have been restored.
  virtual void restored_points() {}

protected:
  Record record_;
  std::vector<std::string> warnings_;
};

/// Outcome of a quasi-static growth.
struct QuasiStaticOutcome {
  Ended ended;
  Ledger ledger;  // at the last state
};

/// Continuation of a growth from a checkpoint, and the checkpoints that it writes.
struct Continuation {
  const QuasiStaticLoad* from = nullptr;                  // of a model that has restored the same equilibrium
  std::function<void(const QuasiStaticLoad&)> hold = {};  // sees the load of every one, with the model as it is then
};

/// Lets a model grow, load by load: the plate is linear between advances, so the load factor of the next one is known
/// exactly (theory.md, "Growth"). `observe` sees every state, after the model has chosen. Throws plate::Interrupted
/// where a signal asks for the end.
QuasiStaticOutcome grow_quasi_statically(const Growth& growth, QuasiStaticModel& model,
                                         const std::function<void(const Equilibrium&)>& observe,
                                         const Continuation& continuation = {});

}  // namespace fracture
