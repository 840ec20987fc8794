#pragma once
#include "plate/formulation/boundary.hpp"

namespace plate {

class MovedSupports;
struct Problem;

/// Adds what supports along lines and on parts of the plate hold. Of a part: the points in it. Along a line: at every
/// point next to it the value at the piece of the line that is next to the point, w + (x - x_k) . psi.
void hold_inside(Boundary& boundary, const std::vector<Support>& supports, const MovedSupports& moved);

/// Fixes w, and of a clamp the rotations, of a point for a holder.
void hold_point(Boundary& boundary, std::uint32_t point, std::uint32_t holder, const MovedSupports& moved);

/// The same for a place next to a point: w + (x - x_k) . psi is held there, or of a clamp the point itself.
void hold_place(Boundary& boundary, std::uint32_t point, const geometry::Point& at, std::uint32_t holder,
                const MovedSupports& moved);

/// Places that lie on the lines and boundaries of parts that supports hold, at most `spacing` apart [length]; none
/// nearer to edges and cracks than half of that.
std::vector<geometry::Point> places_inside(const std::vector<Support>& supports, const geometry::Outline& outline,
                                           const std::vector<geometry::CrackPath>& cracks, double spacing);

/// The places where loads and supports act, which get a point of their own. `spacing`: between those on lines.
std::vector<geometry::Point> own_places(const Problem& problem, const std::vector<geometry::CrackPath>& paths,
                                        double spacing);

}  // namespace plate
