#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "plate/formulation/constraints.hpp"
#include "plate/solve/matrices/factor.hpp"
#include "plate/solve/stretching.hpp"

namespace plate {

class Formulation;

/// An equilibrium on the way to the full load.
struct LoadStep {
  double factor = 0;  // of all loads
  std::size_t iterations = 0;
  double residual = 0;            // relative to the load
  double largest_deflection = 0;  // |w| of any point [length]
  double strain_energy = 0;
  bool stable = true;    // the stiffness is positive there
  bool snapped = false;  // on the way from the step before it was not
};

/// Limits of the search for an equilibrium with large deflections.
struct LargeDeflectionOptions {
  double tolerance = 1e-6;  // of the residual, as in StaticOptions
  std::function<void(double factor, std::size_t iterations, double residual)> progress = {};
};

/// Equilibrium of a plate with large deflections.
struct LargeDeflections {
  State bending, membrane;
  std::vector<LoadStep> steps;
  double bending_energy = 0, membrane_energy = 0;
  double external_work = 0;  // of the loads along the steps
  Forces on_bending;         // of the stretched middle plane on the deflections
  Stretch stretch;           // of the middle plane by the deflections
  Eigen::Matrix3Xd membrane_forces;
  std::size_t iterations = 0, factor_bytes = 0;
  bool converged = false;
  std::string stop_reason;

  bool snapped() const;
};

/// Constraints of a plate in its plane, with pins that hold the rigid motions which no support prevents.
Constraints pinned(const Formulation& membrane);

/// A plate and the same points in their plane (PlateLaw::membrane) as one elastic body with von Karman's strains.
/// States of both stand behind each other: the plate's points, then the same points in their plane.
class StretchedPlate {
public:
  /// Both must outlive this. Pins hold the rigid motions that no support of the plane prevents.
  StretchedPlate(const Formulation& plate, const Formulation& membrane);
  ~StretchedPlate();

  /// Equilibrium under all loads, which grow together in steps that find their own length.
  /// @throws NumericalError  where a number is not finite
  LargeDeflections equilibrium(const LargeDeflectionOptions& options) const;

  /// The plane in equilibrium with given deflections and without loads [3 x points].
  State plane_at_rest(const State& bending) const { return in_plane(bending, 0); }

private:
  struct Now;
  struct Path;
  State in_plane(const State& bending, double factor) const;
  Now at(const State& bending, double factor) const;
  std::unique_ptr<Factor> tangent(const Now& now, double& shift) const;
  State direction(const Factor& tangent, const Forces& force) const;
  bool iterate(Now& now, double factor, const LargeDeflectionOptions& options, LoadStep& step) const;
  double norm(const Forces& forces) const;
  double by_loads(const State& bending, const State& membrane) const;
  void look_ahead(Path& path) const;
  double work_between(const Path& before, const Path& after) const;
  bool advance(Path& path, const LargeDeflectionOptions& options, LargeDeflections& result) const;

  const Formulation& plate_;
  const Formulation& membrane_;
  std::unique_ptr<const Stretching> stretching_;
  PointMatrix bending_;
  Constraints of_plane_, of_both_;
  Forces load_, load_in_plane_, weight_;
  Unknowns unknowns_, unknowns_in_plane_;
  std::unique_ptr<const Factor> plane_;  // of the plate in its plane
};

}  // namespace plate
