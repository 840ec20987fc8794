#pragma once
#include <functional>
#include <optional>

#include "plate/edges/boundary_conditions.hpp"
#include "plate/edges/stiffness_rows.hpp"
#include "plate/model/space.hpp"
#include "plate/model/state.hpp"

namespace plate {

/// Orders of the Taylor expansions beyond the edges. A plate in pure bending has rotations of first and deflections of
/// second order without shear: the deflection must be one order above the rotations, or fictitious nodes shear.
struct ExpansionOrders {
  int deflection = 2, rotation = 1;
};

/// @throws std::invalid_argument  rotations of order 0, deflections of order 1 or below the rotations
void check_orders(const ExpansionOrders& orders);

/// Edges in any direction, and round holes: surface nodes on them, where the section forces are those of the local
/// plate.
struct LocalEdges : ObliqueEdges {
  Section section;
};

/// A plate with surface nodes on its edges (Sca23, for the Mindlin plate). All families are full but for what cracks
/// cut, which stay a horizon away from the edges.
struct SurfacePlate {
  LatticeBody body;
  LatticeBonds bonds;
  geometry::Point first{0, 0};  // the node (0, 0) of the lattice [length]
  ExpansionOrders orders = {};
  FluxRule rule = FluxRule::lever;
  CrackedFamilies cuts = {};
  std::optional<LocalEdges> oblique = {};  // where not all edges are along the axes; body.surface is empty then

  int surfaces() const { return int(oblique ? oblique->nodes.size() : body.surface.size()); }
  int unknowns() const { return unknowns_per_point * (body.real + surfaces()); }
  geometry::Point at(int k) const;  // [length]
  geometry::Point at_surface(int s) const;
  geometry::Point normal(int s) const;  // outward
  int inner(int s) const;               // a real node next to it
  double length(int s) const;           // of its part of the edge [length]
  double beyond(int s) const;           // how far the edge lies beyond the border of the outermost cell [length]
};

/// Constructs a plate of any outline on the lattice of geometry::lattice; orders (2, 1) unless all edges are along the
/// axes.
/// @throws Refused  as rectilinear_body() and oblique_edges() do
SurfacePlate surface_plate(const Section& section, const Discretization& discretization,
                           const geometry::Outline& outline);

/// Values of all nodes from those of real and, behind them, surface nodes: 3 nodes x unknowns().
WeightRows expansion(const SurfacePlate& plate);

/// Stiffness of a plate with edges along the axes: equilibrium of real nodes (Sca23 33) and fluxes of surface nodes
/// (Sca23 36), with the fictitious nodes in them expanded. Deflections and rotations are expanded about the nearest
/// surface node, dilatations to one order below the rotations about the nearest real node. Not symmetric.
/// @throws std::invalid_argument  as check_orders() does
/// @throws Refused                where the plate has too few points for the orders
SparseStiffness stiffness(const SurfacePlate& plate);

/// Stiffness whose rows of held unknowns are those of rows_with_reactions().
SparseStiffness stiffness_with_reactions(const SurfacePlate& plate, const std::function<bool(int unknown)>& held);

/// Loads at a place, conjugate to w, theta_x and theta_y [force / area, force / length].
using AreaLoad = std::function<PointValues(const geometry::Point& at)>;
/// The conditions at a place of the edge with this outward normal.
using EdgeConditions = std::function<EdgeCondition(const geometry::Point& at, const geometry::Point& normal)>;

/// Right sides and what is held.
struct EdgeProblem {
  Eigen::VectorXd right;                // [unknowns()]
  std::vector<PrescribedUnknown> held;  // of surface nodes
};

/// Right sides and held unknowns under these conditions and this load. The strip between the border of an outermost
/// cell and an edge beyond it is loaded too; its load goes to the surface node.
EdgeProblem edge_problem(const SurfacePlate& plate, const EdgeConditions& edges, const AreaLoad& load);

/// The stiffness under these conditions: stiffness(), or oblique_stiffness() with rows of what they hold.
SparseStiffness stiffness_under(const SurfacePlate& plate, const EdgeConditions& edges);

using StiffnessRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Rows of real and surface nodes by the lever, `own`, but for what is held: these by crossing points, `crossed`, so
/// that reactions leave nothing out. By the lever a bond over a corner of a held and a free edge puts on the free one
/// what its crossing point does not: fluxes by crossing points there are not 0 although those by the lever are. What
/// they sum up to within the nearer half of a free stretch is a force on the held face beside its end, and is added
/// there, with its couple about that face where it holds it. Nothing of it in homogeneous states, where both rules are
/// exact.
StiffnessRows rows_with_reactions(const SurfacePlate& plate, const StiffnessRows& own, const StiffnessRows& crossed,
                                  const std::function<bool(int unknown)>& held);

/// Measures of the squared frequencies, lambda = omega^2, of a plate with surface nodes.
struct EdgeSpectrum {
  double lowest;     // real part of lambda, over the largest |lambda|; below 0: a motion that grows
  double asymmetry;  // largest |Im omega| over the largest |omega|: 0 in a symmetric plate
  int negative;      // how many real parts are below 0, but for rounding
};

/// Surface nodes follow without mass: what is free of them is eliminated, what is held is 0. All eigenvalues of a dense
/// matrix: for plates of some hundred points. It says whether conditions at edges are sound before anything iterates or
/// marches on them.
EdgeSpectrum spectrum(const SurfacePlate& plate, const EdgeConditions& edges, double thickness);

}  // namespace plate
