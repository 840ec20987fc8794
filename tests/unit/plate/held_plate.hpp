#pragma once
#include <optional>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "tests/unit/plate/small_plate.hpp"

/// Plates whose sides are held, for the tests of boundaries and of what their bonds see.
namespace held_plate {

using geometry::Point;

/// 8 x 7 cells, all sides named, horizon 3.015.
inline plate::Boundary held(const std::vector<plate::Support>& supports,
                            const geometry::Outline& outline = geometry::rectangle(0, 0, 8, 7)) {
  const auto d = small_plate::spaced(1);
  return plate::boundary(geometry::lattice(outline, 1), outline, supports, d);
}

inline plate::Support all_round(plate::SupportKind kind) {
  return {kind, {"left", "right", "bottom", "top"}, {}};
}

inline std::optional<std::uint32_t> point_at(const plate::Boundary& b, const Point& u) {
  for (std::uint32_t k = 0; k < b.lattice.size(); ++k)
    if ((b.lattice[k] - u).norm() < 1e-9) return k;
  return std::nullopt;
}

inline geometry::Outline angle_shape() {  // an L, its re-entrant corner at (5, 4)
  return {{{{0, 0}, {10, 0}, {10, 4}, {5, 4}, {5, 9}, {0, 9}}, {"south", "east", "step", "wall", "north", "west"}}, {}};
}

}  // namespace held_plate
