#pragma once
#include <vector>

#include "plate/formulation/attached_stiffness.hpp"

namespace geometry {
struct Tessellation;
}

namespace plate {

struct Problem;
struct Stiffener;

/// The stiffness of a beam on points on the edges and between them: elements of the beam of Bernoulli (Hermite's cubic
/// lines), or of Timoshenko, between places a spacing apart (theory.md, "Stiffeners").
void add_stiffener(const Stiffener& stiffener, const geometry::Tessellation& cells, AttachmentSum& sum);

/// Mass of all stiffeners at every point [mass]; empty where none has any.
std::vector<double> stiffener_masses(const Problem& problem, const geometry::Tessellation& cells);

}  // namespace plate

namespace geometry {
struct Cloud;
struct Tessellation;
}  // namespace geometry

namespace plate {

struct Problem;

/// All foundations and springs of a problem on points in the middles of cells.
AttachedStiffness attached_stiffness(const Problem& problem, const geometry::Cloud& cloud);

/// Foundations and springs of a problem on points that are corners of cells.
AttachedStiffness attached_stiffness(const Problem& problem, const geometry::Tessellation& cells);

}  // namespace plate
