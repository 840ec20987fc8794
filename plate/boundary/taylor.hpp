#pragma once
#include <Eigen/Core>

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

}  // namespace plate
