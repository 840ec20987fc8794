#pragma once
#include "plate/boundary/conditions.hpp"
#include "plate/boundary/crossings.hpp"
#include "plate/boundary/extrapolation.hpp"
#include "plate/surface/cut_families.hpp"
#include "plate/surface/oblique/expansion.hpp"

namespace plate {

/// What is linear in the values of all nodes U, those of fictitious nodes among them (w, theta_x, theta_y of node k
/// from 3 k on), and in their dilatations. Rows: of real nodes, then of surface nodes, three each.
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
PlateActions actions(const LatticeBody& body, const LatticeBonds& bonds, FluxRule rule, const CutFamilies& cuts = {});

/// What bonds to points beyond the edges do to the plate: of each edge node, the forces of the bonds to the points that
/// are expanded about it, and their couples about it. They balance what all bonds do to the real nodes. No dilatations.
PlateActions edge_actions(const LatticeBody& body, const LatticeBonds& bonds, const ObliqueEdges& edges,
                          const CutFamilies& cuts = {});

}  // namespace plate
