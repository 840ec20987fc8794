#pragma once

#include "plate/galerkin/operator.hpp"
#include "plate/galerkin/stiffness.hpp"
#include "plate/galerkin/supports.hpp"
#include "plate/model/loads.hpp"

/// Galerkin plates small enough for dense matrices.
namespace galerkin_plate {

inline const plate::Section section{1000, 0.3, 0.1, 5.0 / 6, 2};

geometry::Tessellation cells(const geometry::Outline& outline, double spacing,
                             const std::vector<geometry::Polyline>& cracks = {}, const geometry::Grading& grading = {});

/// Returns the cells with every point that is on no edge or crack moved by up to `share` of a spacing; squares become
/// triangles.
geometry::Tessellation perturbed(geometry::Tessellation cells, double share, unsigned seed = 1);

geometry::Outline with_hole();

/// Points that have been moved need bonds of their own.
plate::GalerkinFamilies families(const geometry::Tessellation& cells);

/// Every kind of cells: the lattice, moved points, a hole, cracks along the lattice and across it, a grading.
std::vector<geometry::Tessellation> scenes();

plate::State random_state(std::size_t points, unsigned seed);

/// w = x (kx x + kxy y) / 2 ..., psi = grad w: constant curvatures.
plate::State bent(const geometry::Tessellation& cells, double kx, double ky, double kxy);

/// K of all degrees of freedom, summed from the families.
Eigen::MatrixXd stiffness(const plate::GalerkinFamilies& families, const plate::Section& s);

}  // namespace galerkin_plate
