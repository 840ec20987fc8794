#pragma once
#include <array>
#include "plate/model/section.hpp"
#include "plate/surface/actions.hpp"
#include "plate/surface/oblique/expansion.hpp"

namespace plate {

/// Of w, psi_n, psi_s of an edge node, which are held.
using HeldOfNode = std::array<bool, 3>;

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
SparseStiffness oblique_stiffness(const LatticeBody& body, const LatticeBonds& bonds, const CutFamilies& cuts,
                                  const ObliqueEdges& edges, const Section& section,
                                  const std::vector<HeldOfNode>& held);

/// The directions in the plane of theta about which M_nn and M_ns turn; psi_n = -first . theta, psi_s = -second .
/// theta.
std::array<geometry::Point, 2> turning_directions(const geometry::Point& normal);

}  // namespace plate
