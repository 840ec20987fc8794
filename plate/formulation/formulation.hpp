#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>
#include "geometry/shape/crack_path.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/model/numerical_method.hpp"

namespace geometry {
class Families;
struct Cloud;
}  // namespace geometry

namespace plate {

class Communicator;
class Constraints;
class FamilyOperator;
class Inertia;
class PointSections;
class Stretching;
class TipView;
struct Boundary;
struct FacePair;
struct Layout;
struct Mechanisms;
struct Mesh;
struct Piece;
struct PointMatrix;
struct PlaceShare;
struct Resultants;
struct Section;
struct TimedLoad;

/// The choice that was made. Without `inverse`: the diagonal.
struct ChosenPreconditioner {
  std::unique_ptr<Preconditioner> inverse;
  std::string name;
};

/// Numbers of points by how the position-aware correction matched them.
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

/// Mass of a plate off its middle plane, of every point: integrals of rho z, and of rho z^2 of stiffeners, which
/// Formulation::mass() leaves out [mass length, mass length^2].
struct MassOffsets {
  Eigen::VectorXd first, second;
};

/// Internal force in single precision.
using SingleForce = std::function<void(const Values<float>& state, Values<float>& force)>;

/// A plate that is ready to solve: all that is asked of it. Nothing above asks which it is; its kind says what it
/// lacks.
class Formulation : public Operator {
public:
  ~Formulation() override;
  const FormulationKind& kind() const;
  bool offers(Feature feature) const { return kind().offers(feature); }
  const Problem& problem() const;
  const Section& section() const;
  const PointSections& sections() const;
  const Discretization& discretization() const;
  const std::vector<geometry::CrackPath>& paths() const;
  const std::vector<geometry::Tip>& tips() const;
  const Boundary& boundary() const;
  const Communicator& communicator() const;
  /// True of a part of a plate that several ranks share.
  bool distributed() const;
  const geometry::Cloud& cloud() const;
  /// True where this rank owns the point nearest to the place.
  bool here(const geometry::Point& x) const;
  const Constraints& constraints() const;
  const std::vector<double>& cut() const;
  const std::vector<TimedLoad>& loads() const;
  /// Parts that nothing connects, and parts that hang by bonds along one line.
  const std::vector<Piece>& pieces() const;
  const Mechanisms& mechanisms() const;
  /// True where parts may move without resistance although every piece is held.
  bool may_move() const;
  /// True where every piece is held against all rigid motions.
  bool held() const;

  Forces total_load() const;                       // all loads at their last values together
  Forces first_load() const;                       // all loads as they are at time 0
  double strain_energy(const State& state) const;  // of all ranks
  /// Sum of values of all points, each of the rank that owns it. Collective.
  double sum_of_points(const Eigen::VectorXd& values) const;
  /// Mass per degree of freedom. `rotary`: factor of the rotary inertia.
  Forces mass(double rotary = 1) const;
  std::size_t bonds() const;             // directed, between points of the plate
  std::size_t fictitious_bonds() const;  // directed, all others
  std::size_t fictitious_points() const;

  virtual const geometry::Families& families() const = 0;
  /// Strain energy of every point [points].
  virtual Eigen::VectorXd energies(const State& state) const = 0;
  virtual Resultants resultants(const State& state) const = 0;
  /// The state at a place, exact under rigid motions. Throws Refused where it sees no point near enough.
  virtual std::vector<PlaceShare> interpolation(const geometry::Point& at) const = 0;
  virtual Mesh mesh() const = 0;
  /// Places on the faces of cracks, in the same order on every rank; none in kinds that do not offer
  /// Feature::touching_faces. Collective.
  virtual std::vector<FacePair> face_pairs() const;
  /// Share of each point's surroundings that cracks cut when they were as at the start of their growth.
  virtual std::vector<double> cut_at(const StartOfCracks& start) const = 0;
  virtual std::unique_ptr<TipView> tip_view() const = 0;
  /// The mass matrix that suits Lanczos vectors.
  virtual Inertia inertia(double rotary) const;

  virtual ChosenPreconditioner preconditioner(Preconditioning wanted) const = 0;
  /// Approximation of (K + shift M)^-1 in the search for frequencies, shift > 0; null: use the diagonal.
  virtual std::unique_ptr<Preconditioner> inverse_of_shifted(double shift) const;
  /// The stiffness, with elastic supports. Only of kinds that offer Feature::stretching, as stretching() and
  /// middle_plane().
  virtual PointMatrix stiffness() const;
  /// Large deflections of the plate, of which this is the plate in its plane.
  virtual std::unique_ptr<Stretching> stretching() const;
  /// A plate of the same points in their plane (PlateLaw::membrane). Of a plate that one process holds.
  /// @throws Refused
  virtual std::unique_ptr<Formulation> middle_plane() const;
  /// Derivatives of the energy by the rotations of the plate (rows) and by the displacements of its plane, symmetric
  /// (Problem::coupled()). Only of kinds that offer Feature::stretching.
  virtual PointMatrix coupling() const;
  /// The plate itself, factorised. Only of kinds that offer it.
  virtual std::unique_ptr<Preconditioner> factor() const;
  virtual SingleForce single_precision() const { return {}; }  // nothing in kinds that do not offer it
  /// Bonds over a horizon that may break; none in kinds that do not offer it.
  virtual const FamilyOperator* breaking() const { return nullptr; }

  /// Memory of the formulation itself, beside points and families. `single`: with the forces in single precision.
  virtual std::vector<MemoryPart> memory(bool single) const = 0;
  virtual std::optional<MatchCounts> matched() const { return std::nullopt; }
  /// A line on what a small plate with the same edges tells of them; nothing of kinds that are sound with any.
  virtual std::string of_edges() const { return ""; }
  /// The forces that multipliers add in the equilibrium under all loads, over these; of kinds with multipliers.
  virtual std::optional<double> multipliers(const State&) const { return std::nullopt; }
  /// Warnings about results that are unreliable at this discretisation. `factors`: intensity factors are asked for.
  virtual std::vector<std::string> warnings(bool factors) const = 0;
  /// Advice on how to resolve the layer beside faces that carries K2 and K3: "take discretization.spacing = 0.01".
  virtual std::string remedy() const = 0;
  /// Distance of the pins that alone hold the plate from one common line, where places of points decide about it
  /// [spacings].
  virtual std::optional<double> width_of_pins() const { return std::nullopt; }
  /// Share of deflections by which edges between the points are usually off.
  virtual double error_of_edges() const { return 0; }
  /// Mass off the middle plane. Only of kinds that offer Feature::stretching.
  virtual MassOffsets mass_offsets() const;
  /// Adds to a geometric stiffness, of membrane forces by the strains in the plane alone, those of the curvatures of a
  /// section that couples and the axial forces of stiffeners. Only of kinds that offer Feature::stretching.
  virtual PointMatrix with_coupling_forces(PointMatrix geometric, const State& bending, const State& in_plane) const;
  /// The constraints, with a halo exchange of all points that the stiffness of owned points looks at.
  virtual Constraints constraints_about() const;

protected:
  explicit Formulation(Layout layout);

private:
  std::unique_ptr<const Layout> layout_;
};

/// Memory of a plate that is ready to solve: points, families, loads, and what its formulation keeps beside them.
std::vector<MemoryPart> memory_of(const Formulation& plate, bool single);

/// Wave number of the lowest bending that the supports leave: half a wave between edges that are held, along the longer
/// side where none is [1 / length].
double lowest_wave(const Formulation& plate);

/// Warning about the effect of a factor of the rotary inertia other than 1 on the lowest frequency, which goes as
/// (1 + (k h)^2 / 12)^(-1/2) with the rotary inertia of the plate (theory.md, "Dynamics").
std::vector<std::string> warnings_about_rotary_inertia(const Formulation& plate, double factor);

}  // namespace plate
