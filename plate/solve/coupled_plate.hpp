#pragma once
#include <memory>

#include "plate/formulation/constraints.hpp"
#include "plate/solve/factorised_plate.hpp"
#include "plate/solve/large_deflections.hpp"
#include "plate/solve/matrices/point_matrix.hpp"
#include "plate/solve/statics.hpp"

namespace plate {

/// A matrix of both: points of a plate, then the same points in their plane. `coupling`: of the points of the plane
/// (rows) and of the plate (columns), symmetric.
PointMatrix stacked_matrix(const PointMatrix& plate, const PointMatrix& plane, const PointMatrix& coupling);

/// Equilibrium of a plate whose bending and stretching act on each other.
struct CoupledEquilibrium {
  StaticSolution of_both;          // stacked states
  State bending, membrane;         // the same, one by one
  State strained = no_state();     // where supports have moved: of the bending what is no motion as one rigid body
  Forces on_bending, on_membrane;  // of the plane on the plate, and of the plate on its plane
  double bending_energy = 0, stretching_energy = 0;
  double coupling_energy = 0;  // of kappa . B epsilon, of either sign

  const State& what_strains() const { return strained.cols() > 0 ? strained : bending; }
  double strain_energy() const { return bending_energy + stretching_energy + coupling_energy; }
};

/// A plate and the same points in their plane (PlateLaw::membrane) as one linear elastic body with the energy
/// M . kappa / 2 + N . epsilon / 2 (theory.md, "Coupled sections"). The stiffness of both is factorised once.
class CoupledPlate {
public:
  /// Both must outlive this. Pins hold the rigid motions in the plane that no support prevents.
  /// @throws NumericalError  where the stiffness is not positive
  CoupledPlate(const Formulation& plate, const Formulation& membrane);
  ~CoupledPlate();

  /// `lift`: of supports that have moved, as total_lift().
  /// @throws NumericalError  where a number is not finite
  CoupledEquilibrium equilibrium(const PlateLoads& loads, const StaticOptions& options,
                                 const State& lift = no_state()) const;
  std::size_t factor_bytes() const;

  /// Stiffness of stacked states, what holds these, and the inverse of the stiffness.
  const Operator& of_both() const;
  const Constraints& constraints() const { return constraints_; }
  const Preconditioner& inverse() const;
  /// The linear stiffness of stacked states, with its coupling(); all three must outlive it.
  static std::unique_ptr<const Operator> stiffness(const Formulation& plate, const Formulation& membrane,
                                                   const PointMatrix& coupling);

private:
  class Both;

  StaticSolution lifted(const PlateLoads& loads, const StaticOptions& options, const State& lift) const;

  const Formulation &plate_, &membrane_;
  PointMatrix coupling_;
  Constraints constraints_;
  std::unique_ptr<const Both> both_;
  std::unique_ptr<const AssembledPlate> factor_;
};

}  // namespace plate
