#pragma once
#include "fracture/growth/criteria.hpp"
#include "fracture/growth/kink.hpp"
#include "geometry/shape/crack_extension.hpp"

namespace fracture {

/// Where a tip goes.
struct TipAdvance {
  geometry::Point to;
  double length = 0;                          // of the new piece [length]
  std::optional<geometry::Obstacle> reached;  // an edge, a hole or a crack: the tip is no more
};

/// Straight on by the increment, or with a turn by `angle` [rad]. Turns below a degree are not made; a piece after a
/// turn is at least five spacings long, so that a ring about its tip fits beside the bend. So is one that goes with
/// such a piece of another tip (`long_leg`), and then turns from a fifth of a degree on are made: alike tips stay
/// alike. A tip that would come closer than that to something ahead breaks through to it.
TipAdvance advance(const Growth& growth, const geometry::Outline& outline,
                   const std::vector<geometry::Polyline>& cracks, double spacing, const geometry::Tip& tip,
                   double angle, bool long_leg);

/// Breaks through to what is nearest ahead or beside: of tips so near to an edge or a crack that no ring fits between.
/// None where what leaves no room for a ring is neither.
std::optional<TipAdvance> break_through(const geometry::Outline& outline, const std::vector<geometry::Polyline>& cracks,
                                        double spacing, const geometry::Tip& tip);

/// Lets tips that have reached each other's meet halfway, as none is before the other.
void meet_halfway(const std::vector<geometry::Tip>& tips, std::vector<std::optional<TipAdvance>>& ways);

/// "crack 1"; of an edge or a hole its name, "'left'"
std::string name_of(const geometry::Obstacle& obstacle);

}  // namespace fracture
