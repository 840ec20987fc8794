#pragma once
#include "cases/papers/bodies/solid.hpp"

/// The four bars of Sca21 5, by Lagrange multipliers (Sca21) and by surface nodes (Sca23), and without corrections.
namespace boundary_bodies {

/// A bar of length 1 m held at 0, with a force at its end and a load along it (Sca21, table 3).
struct BarProblem {
  std::string name;                     // "5.1 clamped bar under traction"
  double end_force;                     // [N]
  std::function<double(double)> load;   // at x [N/m^3]
  std::function<double(double)> local;  // displacement at x by the local theory [m] (Sca21 65 to 68)
  int degree;                           // of the solution; 99: no polynomial
};

std::vector<BarProblem> bar_problems();

/// Its 20 nodes, horizon of three spacings.
Solid bar_of_table_3();

/// Loads of the nodes [N], then of the surface nodes at 0 and at the end.
Eigen::VectorXd bar_forces(const Solid& bar, const BarProblem& problem);

struct BarSolution {
  Eigen::VectorXd u;                  // of the nodes [m]
  double reaction;                    // at 0, along x [N]: minus all loads
  Eigen::Vector2d multipliers{0, 0};  // of the value at 0 [N], of the flux at the end [m]
};

/// Fictitious nodes expanded to this order about the nearest real node, conditions by multipliers (Sca21 63).
BarSolution bar_with_multipliers(const BarProblem& problem, int order);
/// Fictitious nodes expanded about surface nodes, which have the conditions (Sca23 37).
BarSolution bar_with_surface_nodes(const BarProblem& problem, int order);
/// No fictitious nodes: the first node has the local solution, the last one the force (Sca21 5).
BarSolution uncorrected_bar(const BarProblem& problem);

/// Sca21 64 in percent: the error of each node over its own displacement by the local theory.
Eigen::ArrayXd bar_errors(const Eigen::VectorXd& u, const BarProblem& problem);

}  // namespace boundary_bodies
