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

/// Is a turn made?
bool turns(double angle);

/// Breaks through to what is nearest: of tips beside an edge or a crack.
TipAdvance break_through(const geometry::Outline& outline, const std::vector<geometry::Polyline>& cracks,
                         const geometry::Tip& tip);

/// "crack 1"; of an edge or a hole its name, "'left'"
std::string name_of(const geometry::Obstacle& obstacle);

}  // namespace fracture
