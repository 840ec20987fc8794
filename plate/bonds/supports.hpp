#pragma once
#include "plate/formulation/boundary.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/section.hpp"

/// Supports of a plate of bonds over a horizon, and which of its points see each other (theory.md, "Supports").
namespace plate {

/// `outline` in lattice units. `motions`: of supports that loads move. `map`: of the ranks that share the plate,
/// without its points. Of a membrane w is held everywhere. `others`: supports of the plate in its plane, or across it
/// for a plate in its plane, whose points beyond edges are points here, too, without bonds.
Boundary boundary(geometry::Cloud cloud, const geometry::Outline& outline, const std::vector<Support>& supports,
                  const Discretization& discretization, const std::vector<SupportMotion>& motions = {},
                  PointMap map = {}, PlateLaw law = PlateLaw::bending, const std::vector<Support>& others = {});

/// True where the plate goes on beyond the side, as images.
bool has_images(const Side& side);

/// Predicate for two points that may be bonded: the bond stays in the plate, or leaves it only across the sides that
/// its fictitious point belongs to. `outline` in lattice units; `boundary` must outlive the answer.
geometry::Pairwise sees(const Boundary& boundary, const geometry::Outline& outline, double horizon_ratio);

}  // namespace plate
