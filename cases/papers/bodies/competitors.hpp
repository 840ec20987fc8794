#pragma once
#include "cases/papers/bodies/loaded.hpp"

/// Other corrections at boundaries, as small as they can be, in the plane: what surface nodes are compared with (Sca23
/// 5). Conditions act at nodes next to faces (`on_nodes`) but for mirror nodes.
namespace boundary_bodies {

/// Position-aware linear solid (Mitchell, Silling, Littlewood 2015): each node's influences for the dilatation and for
/// the deviator are the nearest to the given ones that have the local moduli under stretch along x, along y and shear.
Eigen::MatrixXd position_aware_stiffness(const Solid& solid);

/// Mirror nodes (Zhao, Jafarzadeh, Chen, Bobaru 2020): two horizons of fictitious nodes. A held component is odd about
/// the face, the others have the normal derivative that the local law gives to the traction. tangential: that law takes
/// tangential derivatives from the outermost nodes; else it leaves them out.
Eigen::VectorXd with_mirror_nodes(const Solid& solid, const Conditions& conditions, bool tangential);

/// Differential operator of second order (Madenci et al. 2016; Behera et al. 2022): conditions on the outermost nodes
/// from first derivatives, the local equations of motion from second ones within two horizons of a face, bonds inside.
/// A component at a corner has the condition of the face that it is normal to.
/// stress_at_nodes: tractions are taken where the nodes are, half a spacing inside, as if the stress were known there.
Eigen::VectorXd with_differential_operator(const Solid& solid, const Conditions& conditions, const Field& solution,
                                           bool stress_at_nodes = false);

}  // namespace boundary_bodies
