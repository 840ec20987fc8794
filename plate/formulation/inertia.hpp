#pragma once
#include <Eigen/SparseCore>
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/sections.hpp"

namespace geometry {
struct Tessellation;
}

namespace plate {

/// Mass per degree of freedom, diag(rho h, rho h^3 / 12, rho h^3 / 12) of every point times the area (Dai 9), carried
/// over to the free ones; zero at held degrees of freedom and at points that are not active (images that store no
/// energy). `rotary`: factor of the rotary inertia; above 1 thin plates take longer steps (theory.md, "Dynamics").
Forces mass(const PointSections& sections, const std::vector<double>& areas, const std::vector<char>& active,
            const Constraints& constraints, double rotary = 1);

/// Carries the mass of every point over to the free degrees of freedom, with the entries of P^T M P between leaders of
/// one component, as a sum over its rows: a disc that moves in its plane keeps its mass.
Forces whole_mass(Forces mass, const Constraints& constraints);

/// The mass matrix of a plate on its free degrees of freedom.
class Inertia {
public:
  /// Diagonal, as from mass().
  explicit Inertia(Forces mass) : diagonal_(std::move(mass)) {}

  /// The consistent mass of the cells of a Galerkin plate, in which deflection and rotations are linear, in squares
  /// bilinear (theory.md, "Dynamics"). `rotary`: factor of the rotary inertia. `constraints` must outlive this.
  Inertia(const PointSections& sections, const geometry::Tessellation& cells, const Constraints& constraints,
          double rotary);

  /// A matrix of all values of a state, as State::data(), symmetric. `constraints` must outlive this.
  Inertia(Eigen::SparseMatrix<double> of_values, const Constraints& constraints)
      : areas_(std::move(of_values)), constraints_(&constraints) {}

  /// P^T M u of u = P q [3 x points].
  Forces operator()(const State& state) const;
  /// M u, not carried over to the free degrees of freedom; only of cells.
  Forces whole(const State& state) const;

private:
  Forces diagonal_;  // or, of cells:
  using Products = Eigen::SparseMatrix<double>;
  Products areas_;         // integrals of products, where the section varies times rho h [length^2]; or of all values
  Products rotary_areas_;  // where the section varies, times its rotary inertia
  double translation_ = 0, rotation_ = 0;
  const Constraints* constraints_ = nullptr;
};

}  // namespace plate
