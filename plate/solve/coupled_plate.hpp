#pragma once
#include <memory>
#include <optional>

#include "plate/formulation/constraints.hpp"
#include "plate/formulation/elastic_supports.hpp"
#include "plate/solve/crack_contact.hpp"
#include "plate/solve/factorised_plate.hpp"
#include "plate/solve/large_deflections.hpp"
#include "plate/solve/matrices/point_matrix.hpp"
#include "plate/solve/pushing_supports.hpp"
#include "plate/solve/statics.hpp"

namespace plate {

/// A matrix of both: points of a plate, then the same points in their plane. `coupling`: of the points of the plane
/// (rows) and of the plate (columns), symmetric.
PointMatrix stacked_matrix(const PointMatrix& plate, const PointMatrix& plane, const PointMatrix& coupling);

/// Equilibrium of a plate whose bending and stretching act on each other, by its section or by faces that touch.
struct CoupledEquilibrium {
  StaticSolution of_both;          // stacked states
  State bending, membrane;         // the same, one by one
  State strained = no_state();     // where supports have moved: of the bending what is no motion as one rigid body
  Forces on_bending, on_membrane;  // of the plane on the plate, and of the plate on its plane
  double bending_energy = 0, stretching_energy = 0;
  double coupling_energy = 0;                  // of kappa . B epsilon, of either sign
  std::optional<TouchingFaces> touching = {};  // where faces of cracks may touch; its changes are empty
  std::optional<LiftedSupports> lifted = {};   // where supports only push

  const State& what_strains() const { return strained.cols() > 0 ? strained : bending; }
  double strain_energy() const { return bending_energy + stretching_energy + coupling_energy; }
};

/// A plate and the same points in their plane (PlateLaw::membrane) as one elastic body with the energy
/// M . kappa / 2 + N . epsilon / 2 (theory.md, "Coupled sections"), linear but for faces of cracks that touch, supports
/// that only push, and soil that lifts off. The stiffness of both is factorised once, and again for each other contact
/// of the soil.
class CoupledPlate {
public:
  /// Both must outlive this. Pins hold the rigid motions in the plane that no support prevents.
  /// @throws NumericalError  where the stiffness is not positive
  CoupledPlate(const Formulation& plate, const Formulation& membrane);
  ~CoupledPlate();

  /// `lift`: of supports that have moved, as total_lift().
  /// @throws NumericalError  where a number is not finite, the search for what touches fails, or nothing holds the
  /// plate on its soil or supports any more
  CoupledEquilibrium equilibrium(const PlateLoads& loads, const StaticOptions& options,
                                 const State& lift = no_state()) const;
  std::size_t factor_bytes() const;

  /// Stiffness of stacked states with contact of soil everywhere, what holds these, and the inverse of the stiffness.
  const Operator& of_both() const;
  const Constraints& constraints() const { return constraints_; }
  const Preconditioner& inverse() const;
  /// The stiffness of stacked states, with the coupling() of the plate; all three must outlive it.
  static std::unique_ptr<const Operator> stiffness(const Operator& plate, const Operator& membrane,
                                                   const PointMatrix& coupling);

private:
  class Linear;
  /// Contact of supports that only push and of the faces of cracks.
  struct Contacts {
    Eigen::VectorXd gaps;              // of all points of these supports [length]
    Eigen::VectorXd openings, forces;  // of all rows of faces
  };

  StaticSolution linear(const Linear& both, const PlateLoads& loads, const StaticOptions& options,
                        const State& lift) const;
  PlateLoads with_contact(const PlateLoads& loads, const Contacts& contacts) const;
  State with_gaps(const State& lift, const Contacts& contacts) const;
  StaticSolution touched(const Linear& both, const PlateLoads& loads, const StaticOptions& options, const State& lift,
                         Contacts& contacts) const;
  StaticSolution on_soil(const PlateLoads& loads, const StaticOptions& options, const State& lift,
                         Contacts& contacts) const;
  CoupledEquilibrium parts_of(StaticSolution both) const;

  const Formulation &plate_, &membrane_;
  PointMatrix coupling_;
  Constraints constraints_;
  std::optional<FaceRows> rows_;        // where there are faces that may touch
  std::optional<PushedPoints> pushed_;  // where supports only push
  std::unique_ptr<const Linear> everywhere_;
};

}  // namespace plate
