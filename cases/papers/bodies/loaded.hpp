#pragma once
#include "cases/papers/bodies/solid.hpp"

/// Bodies with displacements and tractions on their faces, and loads inside.
namespace boundary_bodies {

struct Conditions {
  std::function<bool(const plate::SurfaceNode&, int component)> held;  // the others have tractions
  Field displacement;                                                  // of what is held
  std::function<Eigen::Vector3d(const Eigen::Vector3d& at, const Eigen::Vector3d& normal)> traction;  // [force / area]
  Field load;  // [force / volume]
};

/// Unknowns of real nodes and, behind them, surface nodes, of a body under these conditions (Sca23 3).
Eigen::VectorXd with_surface_nodes(const Solid& solid, int order, plate::FluxRule rule, const Conditions& conditions);

/// Solves for half the unknowns where body, loads and supports are symmetric about the middle of an axis with an even
/// number of nodes.
Eigen::VectorXd with_surface_nodes_mirrored(const Solid& solid, int order, plate::FluxRule rule,
                                            const Conditions& conditions, int axis);

/// Conditions at the nodes next to faces: the field that is the solution, or the traction (Sca23 4). `K`: of real
/// nodes.
Eigen::VectorXd on_nodes(const Solid& solid, const plate::SparseStiffness& K, const Conditions& conditions,
                         const Field& solution);

/// Solves without any correction of the boundary.
Eigen::VectorXd uncorrected(const Solid& solid, const Conditions& conditions, const Field& solution);

/// Loads inside, over real nodes.
Eigen::VectorXd loads(const Solid& solid, const Conditions& conditions);

/// Errors of real nodes: all components over the largest of each (Sca23 38).
struct Errors {
  double largest, mean;
};
Errors errors(const Solid& solid, const Eigen::VectorXd& u, const Field& solution);

/// The largest of each component, over the largest of it (Sca23 44).
Eigen::VectorXd largest_errors(const Solid& solid, const Eigen::VectorXd& u, const Field& solution);

/// Held across the lower faces, pulled with the traction p out of the upper face of an axis.
Conditions pulled(int axis, double p);

}  // namespace boundary_bodies
