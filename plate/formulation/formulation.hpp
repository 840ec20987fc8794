#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "geometry/shape/crack_path.hpp"
#include "plate/formulation/inertia.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/formulation/mesh.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/formulation/parts/mechanisms.hpp"
#include "plate/formulation/preconditioner.hpp"
#include "plate/formulation/stopwatch.hpp"
#include "plate/formulation/tip_view.hpp"
#include "plate/model/formulation_kind.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/solver_choices.hpp"

namespace plate {

class LatticeOperator;

/// What every formulation makes of a problem: points, supports, nodal loads.
struct Layout {
  Problem problem;
  std::vector<geometry::CrackPath> paths;  // [length]
  std::vector<geometry::Tip> tips;
  Boundary boundary;
  std::vector<double> cut;  // per point of the plate: share of its surroundings that cracks sever
  std::vector<TimedLoad> loads;
  std::vector<Piece> pieces = {};
  Mechanisms mechanisms = {};
};

/// The choice that was made. Without `inverse`: the diagonal.
struct ChosenPreconditioner {
  std::unique_ptr<Preconditioner> inverse;
  std::string name;
};

/// How many points were matched in which way by the position-aware correction.
struct MatchCounts {
  std::size_t exact = 0, blended = 0, arbitrary_horizon = 0;
};

/// Memory of a part of a plate, and the stage of a run that fills it.
struct MemoryPart {
  std::string name, stage;
  double bytes;
};

/// Cracks before they grew, and Formulation::cut() then.
struct StartOfCracks {
  std::vector<geometry::Polyline> cracks;
  std::vector<double> cut;
};

/// Internal force in single precision.
using SingleForce = std::function<void(const Values<float>& state, Values<float>& force)>;

/// A plate that is ready to solve: all that solvers, outputs and intensity factors ask of it. Nothing above asks which
/// it is; what it cannot do, its kind says.
class Formulation : public Operator {
public:
  const FormulationKind& kind() const { return *layout_.problem.discretization.formulation; }
  bool offers(Feature feature) const { return kind().offers(feature); }

  const Problem& problem() const { return layout_.problem; }
  const Section& section() const { return layout_.problem.section; }
  const Discretization& discretization() const { return layout_.problem.discretization; }
  const std::vector<geometry::CrackPath>& paths() const { return layout_.paths; }
  const std::vector<geometry::Tip>& tips() const { return layout_.tips; }
  const Boundary& boundary() const { return layout_.boundary; }
  const geometry::Cloud& cloud() const { return layout_.boundary.cloud; }
  const Constraints& constraints() const { return layout_.boundary.constraints; }
  const std::vector<double>& cut() const { return layout_.cut; }
  const std::vector<TimedLoad>& loads() const { return layout_.loads; }
  /// Parts that nothing connects, and parts that hang by bonds along one line.
  const std::vector<Piece>& pieces() const { return layout_.pieces; }
  const Mechanisms& mechanisms() const { return layout_.mechanisms; }
  /// May parts move without resistance although every piece is held?
  bool may_move() const { return mechanisms().motions > 0 || !mechanisms().searched; }
  /// Is every piece held against all rigid motions?
  bool held() const;

  Forces total_load() const;  // all loads at their last values together
  Forces first_load() const;  // all loads as they are at time 0
  double strain_energy(const State& state) const { return energies(state).sum(); }
  /// Mass per degree of freedom. `rotary`: factor of the rotary inertia.
  Forces mass(double rotary = 1) const;
  std::size_t bonds() const;             // directed, between points of the plate
  std::size_t fictitious_bonds() const;  // directed, all others

  virtual const geometry::Families& families() const = 0;
  /// Strain energy of every point [points].
  virtual Eigen::VectorXd energies(const State& state) const = 0;
  virtual Resultants resultants(const State& state) const = 0;
  /// The points of the plate about a place that no crack parts from it. Throws Refused where none is near enough.
  virtual std::vector<Share> interpolation(const geometry::Point& at) const = 0;
  virtual Mesh mesh() const = 0;
  /// Share of each point's surroundings that cracks severed when they were as at the start of their growth.
  virtual std::vector<double> cut_at(const StartOfCracks& start) const = 0;
  virtual std::unique_ptr<TipView> tip_view() const = 0;
  /// The mass matrix that suits Lanczos vectors.
  virtual Inertia inertia(double rotary) const { return Inertia(mass(rotary)); }

  virtual ChosenPreconditioner preconditioner(Preconditioning wanted) const = 0;
  /// The plate itself, factorised. Only of kinds that offer it.
  virtual std::unique_ptr<Preconditioner> factor() const;
  /// Nothing in kinds that do not offer it.
  virtual SingleForce single_precision() const { return {}; }
  /// Bonds over a horizon that may break; none in kinds that do not offer it.
  virtual const LatticeOperator* breaking() const { return nullptr; }

  /// What is kept of the formulation itself, beside points and families. `single`: with the forces in single precision.
  virtual std::vector<MemoryPart> memory(bool single) const = 0;
  virtual std::optional<MatchCounts> matched() const { return std::nullopt; }
  /// What of the results is not to be trusted at this discretisation. `factors`: intensity factors are asked for.
  virtual std::vector<std::string> distrust(bool factors) const = 0;
  /// What would resolve the layer beside faces in which K2 and K3 live: "take discretization.spacing = 0.01".
  virtual std::string remedy() const = 0;
  /// How far the pins that alone hold the plate are from one line, where the places of points decide about that
  /// [spacings].
  virtual std::optional<double> width_of_pins() const { return std::nullopt; }
  /// Share of deflections by which edges between the points are usually off.
  virtual double error_of_edges() const { return 0; }

protected:
  explicit Formulation(Layout layout) : layout_(std::move(layout)) {}

private:
  Layout layout_;
};

/// A problem turned into a plate, with what its user should know, and the seconds that it took.
struct Discretised {
  std::unique_ptr<Formulation> plate;
  std::vector<std::string> warnings;
  Stopwatch stopwatch;
};

/// By the formulation of the problem. Throws Refused where it cannot carry the problem. Whether the plate is held is
/// not asked here.
Discretised discretise(const Problem& problem);

/// The cracks of a problem as paths [length].
std::vector<geometry::CrackPath> crack_paths(const Problem& problem);

/// Wave number of the lowest bending that the supports leave: half a wave between edges that are held, along the longer
/// side where none is [1 / length].
double lowest_wave(const Formulation& plate);

}  // namespace plate
