#pragma once
#include <functional>
#include <vector>

#include "geometry/shape/crack_path.hpp"
#include "plate/formulation/elastic_supports.hpp"
#include "plate/formulation/support_constraints.hpp"
#include "plate/model/section.hpp"

namespace geometry {
struct Tessellation;
}

namespace plate {

/// Rigid disc of a plate whose centre a support holds (theory.md, "Hubs").
struct Hub {
  std::uint32_t holder;               // its number in holders_of()
  geometry::Point centre;             // [length]
  std::vector<std::uint32_t> points;  // that move with it, ascending
};

/// Finds the hubs on points in the middles of cells: each has the points within its circle.
/// @throws Refused  where its points lie on one line, or it fills a hole
std::vector<Hub> hubs_of(const std::vector<Support>& supports, const geometry::Cloud& cloud);

/// Finds the hubs on points that are corners of cells: each has the points on the rim of its hole, or those within its
/// circle. `outline`: in lattice units.
/// @throws Refused  where its points lie on one line
std::vector<Hub> hubs_of(const std::vector<Support>& supports, const geometry::Outline& outline,
                         const geometry::Tessellation& cells);

/// True where a hub moves or turns, in a plate that bends or in its plane: its points then follow one of them.
bool hubs_move(const std::vector<Support>& supports, PlateLaw law);

/// Value of a degree of freedom that moves with a body: its leaders and the motions of its support.
struct BodyValue {
  SupportOffsets::Leaders leaders;
  SupportOffsets::Offsets offsets;
};
/// Function of a place [length] and a component.
using BodyMotion = std::function<BodyValue(const geometry::Point&, std::uint32_t)>;

/// Motion of a hub: in a plate that bends rotations alike and w by the lever, in the plane a motion and a turn. `moved`
/// must outlive the function.
BodyMotion motion_of(const Hub& hub, const Boundary& boundary, const std::vector<Support>& supports, PlateLaw law,
                     const SupportOffsets& moved);
/// Ties a degree of freedom to a body; does nothing where the body follows it.
void tie_to_body(Constraints& constraints, const Dof& dof, BodyValue value);

/// Ties the points of hubs by motion_of(). Before Constraints::resolve().
/// @throws Refused  where another support holds one of the points
void hold_hubs(Boundary& boundary, const std::vector<Hub>& hubs, const std::vector<Support>& supports, PlateLaw law,
               const SupportOffsets& moved);

/// Adds the springs of a hub against w of its centre and against its turn; returns false where it has none.
bool add_hub(const Hub& hub, const Support& support, const std::vector<geometry::Point>& positions,
             ElasticSupportSum& sum);

}  // namespace plate
