#pragma once
#include <Eigen/SparseCore>
#include <functional>
#include "plate/edges/boundary_conditions.hpp"
#include "plate/edges/extrapolation.hpp"
#include "plate/edges/lattice_body.hpp"

/// Ordinary state-based bars, plane bodies and boxes in equilibrium, as in the papers on fictitious and surface nodes.
namespace boundary_bodies {

/// Constants of the dilatation (Sca21 13, Sca23 9) and of the force (Sca21 20, Sca23 11).
struct Material {
  double c_theta, k_theta, k_e;
};
Material bar_material(double young, double poisson);           // Sca21 13, 19
Material plane_strain_material(double young, double poisson);  // Sca23 5
Material plane_stress_material(double young, double poisson);  // the same with the moduli of plane stress
Material space_material(double young, double poisson);         // Sca23 11

/// Where a node of a family is, and the share of its cell within the horizon.
struct Neighbour {
  plate::LatticeBody::Index away;
  double fraction;
};
using Family = std::vector<Neighbour>;

/// Influence as a function of length / horizon.
using Influence = std::function<double(double)>;
double gauss(double ratio);    // Sca23 7
double inverse(double ratio);  // Sca21 23

/// A body, its material and how it is seen.
struct Solid {
  plate::LatticeBody body;
  Material material;
  Family family;       // of a node inside
  double spacing = 1;  // [length]
  double horizon = 3;  // in spacings
  double section = 1;  // of a bar, or thickness of a plane body: volume of a cell / spacing^dimension
  Influence influence = inverse;

  int dimension() const { return body.dimension; }
  double volume() const { return section * std::pow(spacing, dimension()); }
  double area() const { return volume() / spacing; }                   // of a face
  Eigen::Vector3d at(int k) const { return place(body.position(k)); }  // [length], 0 at the lower faces of a box
  Eigen::Vector3d at_surface(int s) const { return place(body.surface_position(s)); }
  Eigen::Vector3d place(const Eigen::Vector3d& position) const;
};

/// Rows that are linear in the displacements of all nodes U, fictitious ones among them, and in their dilatations.
struct Actions {
  plate::WeightRows dilatation;                     // real nodes x unknowns of U
  plate::SparseStiffness of_values, of_dilatation;  // (real nodes, then surface nodes) x dimension: minus the force on
                                                    // the node; the flux times area out of the face
};
Actions actions(const Solid& solid, plate::FluxRule rule);

/// Rows of equilibrium of real nodes (Sca21 54, Sca23 33) and of fluxes of surface nodes (Sca21 60, Sca23 36) with
/// fictitious nodes expanded: displacements to the order, dilatations to one less about the nearest real node.
/// Unknowns: those of real nodes; behind them, where expanded about them, those of surface nodes.
plate::SparseStiffness stiffness(const Solid& solid, plate::Centre centre, int order,
                                 plate::FluxRule rule = plate::FluxRule::crossing_point);

using Field = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

/// Actions on a body whose field goes on beyond it, dilatations from full families everywhere: minus forces on real
/// nodes and fluxes times area that make the field the solution.
Eigen::VectorXd actions_of(const Solid& solid, const Field& field, plate::FluxRule rule);

/// Equilibrium without fictitious nodes: families and weighted volumes as the body cuts them.
plate::SparseStiffness uncorrected_stiffness(const Solid& solid);

/// A field at real nodes and, behind them, surface nodes.
Eigen::VectorXd at_unknowns(const Solid& solid, const Field& field);

}  // namespace boundary_bodies
