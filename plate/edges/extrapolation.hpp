#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "plate/edges/lattice_body.hpp"

namespace plate {

/// Weights of the values at `nodes` whose sum is the value at `at` of a Taylor expansion of the order given about
/// the first node; the other nodes' own expansions give its derivatives (Sca21 42-46, Sca23 25-32). As many nodes as
/// there are terms: the polynomial through all of them. More: least squares, still through the first.
/// @param nodes  dimension x count [length]
/// @param at     dimension
/// @param order  0 or more; polynomials up to it are reproduced
/// @throws Refused  where the nodes do not determine the derivatives
Eigen::VectorXd taylor_weights(const Eigen::MatrixXd& nodes, const Eigen::VectorXd& at, int order);

/// Terms of such an expansion, the value itself among them: (order + dimension over dimension).
int taylor_terms(int dimension, int order);

/// Rows of weights.
using WeightRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Node about which a fictitious value is expanded: the nearest real node, from real nodes (Sca21 30, 42-46), or the
/// nearest surface node, from surface nodes and real nodes (Sca23 29-32).
enum class Centre { real_node, surface_node };

/// Values at all nodes from those at real nodes (Centre::real_node), or at real and, behind them, surface nodes
/// (Centre::surface_node): real nodes keep theirs, fictitious nodes take a Taylor expansion. Straight beyond a face it
/// runs along the column of nodes behind it (Sca21 6.1), at corners over the principal lattice of as many dimensions as
/// the corner has: columns t = 0 to order of order + 1 - t nodes. Nodes as near as the nearest: the mean of their
/// expansions. Sights run straight behind their faces. Order 0 takes the nearest value over. The same rows serve every
/// unknown of a node.
/// @return  values x (real) or values x (real + surface), values those of LatticeBody::values()
/// @throws Refused  where the body has too few nodes for the order
WeightRows extrapolation(const LatticeBody& body, Centre centre, int order);

/// Values at surface nodes from those at real nodes, by the expansion about their inner node (Sca21 58).
/// @return  surface x real
WeightRows surface_values(const LatticeBody& body, int order);

/// Rows for several unknowns of a node, each with its own or all with the same; unknown i of node k is at
/// i + unknowns * k.
/// @throws std::invalid_argument  rows of unlike shapes, or none
WeightRows for_each_unknown(const std::vector<WeightRows>& rows);
WeightRows for_each_unknown(const WeightRows& rows, int unknowns);

}  // namespace plate
