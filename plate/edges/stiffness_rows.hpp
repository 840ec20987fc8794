#pragma once
#include <array>

#include "plate/edges/boundary_conditions.hpp"
#include "plate/edges/extrapolation.hpp"
#include "plate/edges/lattice_body.hpp"
#include "plate/edges/lattice_bonds.hpp"
#include "plate/edges/oblique_edges.hpp"
#include "plate/model/section.hpp"
#include "plate/model/space.hpp"

namespace plate {

/// Linear maps from the values of all nodes U, fictitious nodes included (w, theta_x, theta_y of node k from 3 k on),
/// and from their dilatations. Rows: of real nodes, then of surface nodes, three each.
struct PlateActions {
  WeightRows dilatation;          // real nodes x U [1 / length]
  SparseStiffness of_values;      // minus force and couples on the real nodes; through the cells' faces, see below
  SparseStiffness of_dilatation;  // rows x nodes
};

/// Sums over the families of all nodes (theory (5)), full but for what cracks cut. Of a surface node: the force and the
/// couples, conjugate to theta, with which what lies outside acts on the plate through the face of its cell, spacing
/// times the flux (Sca23 36). A bond that pulls on its inner node with f and m c acts at its cut, t of its length away,
/// with f and m (c - t xi f): the force alone has a moment about the cut. Where an edge lies beyond the border of its
/// cells, the shear force along it, of the inner node's family, turns the strip between: bonds along the edge do not
/// cross it, and the couple along the edge is therefore that at the border and this one.
PlateActions actions(const LatticeBody& body, const LatticeBonds& bonds, FluxRule rule,
                     const CrackedFamilies& cuts = {});

/// Actions on the plate of bonds to points beyond the edges. Rows of each edge node: the forces of the bonds to the
/// points that are expanded about it, and their couples about it. They balance the actions of all bonds on the real
/// nodes. The result has no rows of dilatations.
PlateActions edge_actions(const LatticeBody& body, const LatticeBonds& bonds, const ObliqueEdges& edges,
                          const CrackedFamilies& cuts = {});

/// Flags for w, psi_n and psi_s of an edge node: true where the support holds the value.
using PrescribedOfNode = std::array<bool, unknowns_per_point>;

/// The section forces of the local plate at edge nodes as what the edge does there: Q and the couples of M_nn and M_ns,
/// conjugate to w, theta_x and theta_y, times the length of the part. Derivatives are those of the expansion.
/// @param spacing  [length]
/// @return  3 edge nodes x 3 (real + edge nodes)
WeightRows section_force_rows(const LatticeBody& body, const ObliqueEdges& edges, const Section& section,
                              double spacing);

/// Equilibrium of real nodes and conditions of edge nodes. Rows of an edge node's w: the shear force, or, where w is
/// held, what bonds to points beyond the edge do about the node. Rows of theta: likewise where both rotations are held;
/// else M_nn or D psi_n along the one, M_ns or D psi_s along the other direction.
/// @throws Refused  a node of an edge that is not clamped in a corner so sharp that its own value all but drops out of
///                  the derivatives along the normal: nothing determines it
SparseStiffness oblique_stiffness(const LatticeBody& body, const LatticeBonds& bonds, const CrackedFamilies& cuts,
                                  const ObliqueEdges& edges, const Section& section,
                                  const std::vector<PrescribedOfNode>& held);

/// The directions in the plane of theta about which M_nn and M_ns turn; psi_n = -first . theta, psi_s = -second .
/// theta.
std::array<geometry::Point, 2> turning_directions(const geometry::Point& normal);

}  // namespace plate
