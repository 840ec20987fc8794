#pragma once
#include <array>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>

/// Degrees of freedom: a component of a point. Constraints, supports and loads name them so and know no number. Only
/// memory has numbers: index_in_state() of a State, which keeps all values of one component together, and
/// index_by_points() of matrices that keep the values of a point together. Surface nodes (plate/edges) follow the
/// points of the plate. Kernels keep their fixed component count inside: plate/bonds/rows, plate/formulation/bond_law,
/// plate/solve/lanes, and the force kernels and stiffness lists of plate/galerkin.
namespace plate {

inline constexpr int unknowns_per_point = 3;  // w, theta_x, theta_y

/// Entries of the stiffness between two points.
inline constexpr int entries_per_block = unknowns_per_point * unknowns_per_point;

/// Degree of freedom; ascending by point, then by component.
struct Dof {
  std::uint32_t point;
  std::uint32_t component;  // 0 for w, 1 for theta_x, 2 for theta_y

  friend constexpr auto operator<=>(const Dof&, const Dof&) = default;
};

/// Degree of freedom of a component of a point, given in any integer type.
template <std::integral Number, std::integral Component>
constexpr Dof dof(Number point, Component component) {
  return {static_cast<std::uint32_t>(point), static_cast<std::uint32_t>(component)};
}

/// True of the degrees of freedom w, in units of length; the others are rotations.
constexpr bool is_deflection(const Dof& dof) {
  return dof.component == 0;
}

/// Degrees of freedom of a point, ascending.
template <std::integral Number>
constexpr std::array<Dof, unknowns_per_point> dofs_of(Number point) {
  return {dof(point, 0), dof(point, 1), dof(point, 2)};
}

/// Index of a degree of freedom in the memory of a State of so many points.
constexpr std::size_t index_in_state(const Dof& dof, std::size_t points) {
  return dof.component * points + dof.point;
}

/// Degree of freedom at an index of the memory of a State of so many points: the inverse of index_in_state().
constexpr Dof dof_at(std::size_t index, std::size_t points) {
  return dof(index % points, index / points);
}

/// Index of a component of a point where the values of a point stand together.
template <std::integral Number, std::integral Component>
constexpr Number index_by_points(Number point, Component component) {
  return static_cast<Number>(static_cast<Number>(unknowns_per_point) * point + static_cast<Number>(component));
}

/// Inverse of index_by_points().
template <std::integral Number>
constexpr Dof dof_by_points(Number index) {
  return dof(index / unknowns_per_point, index % unknowns_per_point);
}

}  // namespace plate

template <>
struct std::hash<plate::Dof> {
  std::size_t operator()(const plate::Dof& dof) const noexcept {
    return std::hash<std::uint64_t>{}(std::uint64_t{dof.point} << 32 | dof.component);
  }
};
