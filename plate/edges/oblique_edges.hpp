#pragma once
#include <functional>
#include <vector>

#include "geometry/lattice/cloud.hpp"
#include "geometry/shape/outline.hpp"
#include "plate/edges/extrapolation.hpp"

namespace plate {

/// A node on an edge in any direction, in the middle of its part of the edge. [spacings]
struct EdgeNode {
  geometry::Point at, normal;  // outward
  double length;               // of its part
};

/// Edge nodes, about one a spacing along every edge and every round hole, of equal parts, none at corners.
/// @param outline  [spacings]
std::vector<EdgeNode> edge_nodes(const geometry::Outline& outline);

/// Coefficients of x, y, x^2, xy, y^2 (order 2) or x, y (order 1) about an edge node, in spacings, from values.
struct EdgeFit {
  std::vector<int> nodes;  // real nodes k, edge nodes real + s
  Eigen::MatrixXd terms;   // terms x nodes
};

/// Nodes on edges in any direction, and what is expanded about them. Positions in spacings; node (0, 0) is at the
/// origin.
struct ObliqueEdges {
  std::vector<EdgeNode> nodes;
  std::vector<EdgeFit> deflection, rotation;  // of each edge node, orders 2 and 1
  std::vector<std::vector<int>> nearest;      // of each fictitious node: the nearest edge nodes
  geometry::LatticeUnits units;               // of node (0, 0), for messages
};

/// Predicate: true where one place can be seen from the other, without looking across the outside of the plate.
using Sees = std::function<bool(const geometry::Point& from, const geometry::Point& to)>;

/// Least squares through the edge node over what it sees within 2.5 (order 2) or 2 spacings, with Gaussian weights that
/// fall to exp(-4) there: real nodes, and nodes of edges whose normals differ by less than 37 degrees. Farther, up to
/// 4 spacings, where these do not determine the terms.
/// @throws Refused  where that is not enough
ObliqueEdges oblique_edges(const LatticeBody& body, std::vector<EdgeNode> nodes, const Sees& sees,
                           const geometry::LatticeUnits& units = {});

/// Values at all nodes from those at real and edge nodes: real nodes keep theirs, fictitious ones take what the nearest
/// edge node expands to there, of several the mean.
/// @return  3 nodes x 3 (real + edge nodes)
WeightRows oblique_expansion(const LatticeBody& body, const ObliqueEdges& edges);

/// Values at all nodes from those at real nodes: fictitious ones take the nearest, of several the mean.
/// @return  nodes x real
WeightRows nearest_values(const LatticeBody& body);

}  // namespace plate
