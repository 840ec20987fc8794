#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plate/formulation/constraints.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/crack_contact.hpp"
#include "plate/solve/matrices/factor.hpp"
#include "plate/solve/stretching.hpp"

namespace plate {

class Formulation;
class StretchedContact;
struct Heat;

/// An equilibrium on the way to the full load.
struct LoadStep {
  double factor = 0;  // of all loads but the constant ones
  std::size_t iterations = 0;
  double residual = 0;            // relative to the load
  double largest_deflection = 0;  // |w| of any point [length]
  double strain_energy = 0;       // with what heat stores
  bool stable = true;             // the stiffness is positive there
  bool snapped = false;           // on the way from the step before it was not
  // of a path by arc length
  double arc_length = 0;           // along the path from where the constant loads act alone
  double deflection = 0;           // w of the point that deflects most in the first row of the path [length]
  std::size_t unstable_modes = 0;  // negative eigenvalues of the stiffness
};

/// Limits of the search for an equilibrium with large deflections.
struct LargeDeflectionOptions {
  double tolerance = 1e-6;  // of the residual, as in StaticOptions
  std::function<void(double factor, std::size_t iterations, double residual)> progress = {};
  LoadControl control = LoadControl::load;
  std::size_t max_steps = 500;  // limit of the steps by arc length
};

/// Equilibrium of a plate with large deflections.
struct LargeDeflections {
  State bending, membrane;
  std::vector<LoadStep> steps;
  double bending_energy = 0, membrane_energy = 0;
  double coupling_energy = 0;  // of kappa . B epsilon, of either sign
  double external_work = 0;    // of the loads along the steps
  /// Share of the deflections in the energy stored by heat in the plane (stored() has that of u and v).
  double stored_by_deflections = 0;
  Forces on_bending;  // of the stretched middle plane on the deflections
  Stretch stretch;    // of the middle plane by the deflections
  Eigen::Matrix3Xd membrane_forces;
  TouchingFaces touching;      // its faces alone; none where contact was not asked for
  std::vector<double> limits;  // load factors of limit points of a path by arc length, between its steps
  std::size_t iterations = 0, factor_bytes = 0;
  double largest_rotation = 0;
  bool converged = false;
  std::string stop_reason;

  double strain_energy() const { return bending_energy + membrane_energy + coupling_energy; }
  bool snapped() const;
};

/// Constraints of a plate in its plane, of Formulation::constraints_about(), with pins that hold the rigid motions
/// which no support prevents; of a distributed plate where it is one piece. Collective.
Constraints pinned(const Formulation& membrane);

/// The sum of a matrix and one of its first points.
PointMatrix with_first(const PointMatrix& of_first, const PointMatrix& of_all);

/// The middle plane of a plate (PlateLaw::membrane) in equilibrium with given deflections. Pins hold the rigid motions
/// that no support of the plane prevents.
class MiddlePlane {
public:
  /// `membrane` must outlive this. `bending`: diagonal of the stiffness of other unknowns of the same points, which are
  /// eliminated in the same order; without columns there are none.
  explicit MiddlePlane(const Formulation& membrane, const Forces& bending = no_state());

  /// The displacements under given deflections and a load in the plane.
  State displacements(const State& bending, const Forces& load) const;

  /// Displacements of the flat plate by loads in the plane.
  std::vector<State> solve(const std::vector<Forces>& loads) const;

  const Stretching& stretching() const { return *stretching_; }
  /// Supports and pins.
  const Constraints& constraints() const { return constraints_; }
  /// Diagonal of the folded stiffness, zero at held degrees of freedom.
  const Forces& diagonal() const { return diagonal_; }
  const std::vector<int>& order() const { return order_; }  // of elimination

private:
  std::unique_ptr<const Stretching> stretching_;
  Constraints constraints_;
  Forces diagonal_;
  std::vector<int> order_;
  Unknowns unknowns_;
  std::unique_ptr<const Factor> factor_;
};

/// Nodal forces on a plate and on the same points in their plane.
struct PlateLoads {
  Forces across, in_plane;
  PointMatrix heat = {};                 // stiffness_of_heat() of the heat among those in the plane
  const PlateLoads* constant = nullptr;  // loads that act in full before these grow, and with them; null: none
  /// stored() of both at a share of these loads, beside the constant ones; empty where no heat acts.
  std::function<double(double share, const State& bending, const State& membrane)> stored = {};
};

/// Stretching::stiffness_of_heat of the heat of a plate in its plane; without points where there is none.
PointMatrix stiffness_of_heat(const Formulation& membrane, const Heat& heat);

/// Estimates by what share of the deflections with large deflections those of linear theory are too large (theory.md,
/// "Large deflections"), from a linear equilibrium: its shape is kept, its size is the one of least energy. Negative
/// where loads in the plane make linear theory too small; zero for a state at rest. `membrane`: the same points in
/// their plane. Of the loads those in the plane count.
/// @throws NumericalError  where the plane has no factor
double linear_theory_off(const Formulation& plate, const Formulation& membrane, const State& bending,
                         const PlateLoads& loads);

/// A plate and the same points in their plane (PlateLaw::membrane) as one elastic body with von Karman's strains; the
/// faces of its cracks touch where the problem asks for it.
/// States of both stand behind each other: the plate's points, then the same points in their plane.
class StretchedPlate {
public:
  /// Both must outlive this. Pins hold the rigid motions that no support of the plane prevents.
  StretchedPlate(const Formulation& plate, const Formulation& membrane);
  ~StretchedPlate();

  /// Equilibrium under loads that grow together in steps that find their own length. A path by arc length ends where
  /// the load factor comes to 1 for the first time; no faces may touch then.
  /// @throws NumericalError  where a number is not finite, or the stiffness is singular at a step of a path
  LargeDeflections equilibrium(const PlateLoads& loads, const LargeDeflectionOptions& options) const;

private:
  struct Now;
  struct Path;
  struct Arc;
  struct Way;
  Now at(const PlateLoads& loads, const State& bending, double factor, const Eigen::VectorXd& on_faces) const;
  Now undeformed(const PlateLoads& loads) const;
  PointMatrix stiffness(const Now& now, const PlateLoads& loads, double factor) const;
  std::unique_ptr<Factor> tangent(const Now& now, const PlateLoads& loads, double factor, double& shift) const;
  Way step(const Factor& tangent, const Now& now) const;
  Way rate(const Factor& tangent, const Now& now, const PlateLoads& loads) const;
  void add_contact(const Factor& tangent, const Eigen::VectorXd& change, State& both) const;
  bool iterate(Now& now, const PlateLoads& loads, const LargeDeflectionOptions& options, LoadStep& step) const;
  double norm(const Forces& forces) const;
  void look_ahead(Path& path) const;
  double work_between(const Path& before, const Path& after) const;
  bool advance(Path& path, const LargeDeflectionOptions& options, LargeDeflections& result) const;
  void grow(Path& path, const LargeDeflectionOptions& options, LargeDeflections& result) const;
  double residual(const Now& now, const PlateLoads& loads, double factor) const;
  std::unique_ptr<Factor> inverse_of_any_sign(const Path& path) const;
  double along(const Arc& arc, const State& bending, double factor) const;
  Arc look_along(Path& path, const Arc& before) const;
  bool correct(Path& path, const Arc& along, const LargeDeflectionOptions& options, LoadStep& step) const;
  double work_of_constant(const Path& before, const Path& after) const;
  double work_along(const Path& before, const Path& after, const Arc& first, const Arc& last) const;
  std::optional<double> limit_between(const Path& before, const Path& after, const Arc& first, const Arc& last) const;
  void add_step(Path& path, LoadStep& step, LargeDeflections& result) const;
  bool begin_with_constant(Path& path, const LargeDeflectionOptions& options, LargeDeflections& result) const;
  bool advance_along(Path& path, Arc& arc, const LargeDeflectionOptions& options, LargeDeflections& result) const;
  void follow(Path& path, const LargeDeflectionOptions& options, LargeDeflections& result) const;

  const Formulation& plate_;
  PointMatrix bending_;
  Forces diagonal_;  // of it, folded; zero at held degrees of freedom
  MiddlePlane plane_;
  Constraints of_both_;
  Forces weight_;
  Unknowns unknowns_;
  std::unique_ptr<const StretchedContact> contact_;  // null where no faces may touch
};

}  // namespace plate
