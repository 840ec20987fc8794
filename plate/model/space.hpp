#pragma once
#include <array>
#include <concepts>
#include <cstddef>

/// Numbers the degrees of freedom: point k has unknowns_per_point of them, and component c of point k is degree of
/// freedom unknowns_per_point * k + c. Surface nodes (plate/edges) follow the points of the plate and are numbered the
/// same way. Matrices of forces and constraints use this number; a State keeps all values of one component together,
/// shape [unknowns_per_point x points], so that its memory is counted by the flat index component * points + point.
/// Kernels keep their fixed component count inside: plate/bonds/rows, plate/formulation/bond_law, plate/solve/lanes,
/// and the force kernels and stiffness lists of plate/galerkin.
namespace plate {

inline constexpr int unknowns_per_point = 3;  // w, theta_x, theta_y

/// Entries of the stiffness between two points.
inline constexpr int entries_per_block = unknowns_per_point * unknowns_per_point;

/// Degree of freedom of a component of a point, in the integer type of the point.
template <std::integral Number, std::integral Component>
constexpr Number dof(Number point, Component component) {
  return static_cast<Number>(static_cast<Number>(unknowns_per_point) * point + static_cast<Number>(component));
}

/// Point of a degree of freedom.
template <std::integral Number>
constexpr Number point_of(Number dof) {
  return static_cast<Number>(dof / static_cast<Number>(unknowns_per_point));
}

/// Component of a degree of freedom: 0 for w, 1 for theta_x, 2 for theta_y.
template <std::integral Number>
constexpr Number component_of(Number dof) {
  return static_cast<Number>(dof % static_cast<Number>(unknowns_per_point));
}

/// True of the degrees of freedom w, in units of length; the others are rotations.
template <std::integral Number>
constexpr bool is_deflection(Number dof) {
  return component_of(dof) == 0;
}

/// Degrees of freedom of a point, ascending.
template <std::integral Number>
constexpr std::array<Number, unknowns_per_point> dofs_of(Number point) {
  std::array<Number, unknowns_per_point> result{};
  for (std::size_t c = 0; c < result.size(); ++c) result[c] = dof(point, c);
  return result;
}

/// Index of a degree of freedom in the memory of a State of so many points.
template <std::integral Number>
constexpr std::size_t flat(Number dof, std::size_t points) {
  return static_cast<std::size_t>(component_of(dof)) * points + static_cast<std::size_t>(point_of(dof));
}

/// Degree of freedom at an index of the memory of a State of so many points: the inverse of flat().
constexpr std::size_t dof_of_flat(std::size_t flat, std::size_t points) {
  return dof(flat % points, flat / points);
}

}  // namespace plate
