#pragma once
#include "cases/papers/bodies/fractions.hpp"
#include "plate/edges/surface_plate.hpp"

/// Plates with surface nodes on their edges.
namespace boundary_bodies {

/// Exact shares of the cells in a horizon of three spacings; `fitted`: third shell changed so that the lattice is
/// isotropic.
std::vector<plate::CellShare> cell_shares(bool fitted);

/// What the full families of a lattice make of homogeneous states (theory (16), (17), with the twist of Dai 35).
struct LatticeLaw {
  double D11, D12, D66, S;  // M_xy = 2 D66 kappa_xy
  double S4_over_S2;        // of the shear of a cubic deflection [length^2]
};
LatticeLaw lattice_law(const plate::Section& section, double spacing, const std::vector<plate::CellShare>& shares);

/// From `low` to `high` on the lattice that begins at `corner`, shares of cells as given, twist as in Dai 35.
plate::SurfacePlate plate_of_shares(const plate::Section& section, double spacing,
                                    const std::vector<plate::CellShare>& shares, const geometry::Point& low,
                                    const geometry::Point& high, const geometry::Point& corner);

/// w, psi_x, psi_y at a place.
using PlateField = std::function<Eigen::Vector3d(const geometry::Point&)>;

/// Values of real and surface nodes.
Eigen::VectorXd at_unknowns(const plate::SurfacePlate& plate, const PlateField& field);

/// Largest difference at real nodes over the largest value: of deflections, of rotations.
Eigen::Vector2d off(const plate::SurfacePlate& plate, const Eigen::VectorXd& u, const PlateField& field);

/// Of a rectangle whose edges, loads and numbers of points are symmetric about the middles of both its sides: solved
/// for a quarter of the unknowns.
Eigen::VectorXd solution_of_quarter(const plate::SurfacePlate& plate, const plate::EdgeConditions& edges,
                                    const plate::AreaLoad& load);

}  // namespace boundary_bodies
