#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "geometry/lattice/families.hpp"
#include "plate/formulation/bond_law.hpp"
#include "plate/model/numerical_method.hpp"
#include "plate/model/section.hpp"

namespace plate {

/// omega(xi): horizon / length (Dai et al., section 2.1) or 1.
double influence(Influence kind, double length, double horizon);

/// Share beta of a full cell at `vector` that counts as within the horizon; 0 beyond it.
/// Linear: Madenci & Oterkus 2014; lattice-fitted: theory.md, "Volume correction".
double volume_share(const Discretization& discretization, const Eigen::Vector2d& vector);

/// The vectors of a full family of the square lattice [length].
std::vector<Eigen::Vector2d> full_family(const Discretization& discretization);

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

/// Weights of one bond in the energy of a point (theory (12)): W = a theta^2 + sum (B (s xi)^2 + S (gamma xi)^2),
/// theta = sum D s xi.
struct BondWeights {
  double D = 0;  // [1 / length]
  double B = 0;  // [force length]
  double S = 0;  // [force / length]
};

/// Weights of all bonds of a plate. Points with equal families (bond vectors, areas, parameters) are of one kind and
/// share their weights.
struct HorizonWeights {
  std::vector<std::uint32_t> kind;  // per point
  std::vector<double> a;            // per kind [force length]
  std::vector<std::size_t> first;   // per kind: where its bonds begin; size: kinds + 1
  std::vector<BondWeights> bonds;   // of every kind, in the order of the family

  /// Weights of the i-th bond of point k.
  const BondWeights& of(std::size_t k, std::size_t i) const { return bonds[first[kind[k]] + i]; }
};

/// Points of equal families: the kind of every point, and a point of every kind.
struct FamilyKinds {
  std::vector<std::uint32_t> kind;     // per point
  std::vector<std::uint32_t> example;  // per kind
};

/// `active[k]` = false: a point that stores no energy; it is of another kind than one that does.
FamilyKinds family_kinds(const geometry::Families& families, const std::vector<double>& areas,
                         const std::vector<char>& active);

/// The weights that parameters by point amount to: D = d omega A_j, B = b omega A_j, S = C omega A_j / 4. `parameters`
/// must be the same for points of one kind.
HorizonWeights weights_of_parameters(const geometry::Families& families, const std::vector<BondShape>& shapes,
                                     const std::vector<double>& areas, const FamilyKinds& kinds,
                                     const std::vector<PointParameters>& parameters);

}  // namespace plate
