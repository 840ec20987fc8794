#pragma once
#include <vector>
#include "geometry/lattice/families.hpp"
#include "plate/formulation/bond_law.hpp"
#include "plate/model/discretization.hpp"
#include "plate/model/section.hpp"

namespace plate {

/// The four peridynamic parameters of a point (Dai 1, 2, 4).
struct PointParameters {
  double a = 0;  // a_b [force length]
  double b = 0;  // b_b [force / length^4]
  double d = 0;  // d_b [1 / length^4]
  double C = 0;  // C_s [force / length^6]
};

/// Parameters of a complete disc of radius `horizon`: Dai 7-8 with d_b and b_b the right way round
/// (influence horizon/length), or the same integrals for influence 1.
PointParameters disc_parameters(const Section& section, Influence influence, double horizon);

/// Sums over a family that the parameters are made of; V = h A beta.
struct FamilySums {
  double volume = 0;  // sum V
  double first = 0;   // sum omega xi V
  double second = 0;  // sum omega xi^2 V
  double twist = 0;   // sum omega xi^2 cos^2 sin^2 V
};

/// Adds one bond to the sums. `share`: beta; `area` [length^2] of its other point.
void add(FamilySums& sums, const BondShape& bond, double share, double thickness, double area);

/// Dai 29, 32, 35, 38 for the family that a point has. A family without bonds gets zeros. Dai 35 is held below
/// 8 times the full horizon's b_b, which only bonds along the axes exceed.
PointParameters arbitrary_horizon(const Section& section, TwistMatch match, const FamilySums& sums, double full_twist);

/// Shape of every bond vector of the families: shapes[bond.vector_id].
std::vector<BondShape> bond_shapes(const std::vector<geometry::Point>& vectors, const Section& section,
                                   const Discretization& discretization);

/// Parameters of every point, by one of the corrections that Dai et al. compare. `areas`: area of every point's cell;
/// `active[k]` = false: a fictitious point that only mirrors the plate and stores no energy; its parameters are zero.
std::vector<PointParameters> horizon_parameters(const geometry::Families& families,
                                                const std::vector<BondShape>& shapes, const std::vector<double>& areas,
                                                const std::vector<char>& active, const Section& section,
                                                const Discretization& discretization);

}  // namespace plate
