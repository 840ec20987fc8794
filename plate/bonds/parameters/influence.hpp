#pragma once
#include <Eigen/Core>
#include <vector>
#include "plate/model/discretization.hpp"

namespace plate {

/// omega(xi): horizon / length (Dai et al., section 2.1) or 1.
double influence(Influence kind, double length, double horizon);

/// Share beta of a full cell at `vector` that counts as within the horizon; 0 beyond it.
/// Linear: Madenci & Oterkus 2014; lattice-fitted: theory.md, "Volume correction".
double volume_share(const Discretization& discretization, const Eigen::Vector2d& vector);

/// The vectors of a full family of the square lattice [length].
std::vector<Eigen::Vector2d> full_family(const Discretization& discretization);

}  // namespace plate
