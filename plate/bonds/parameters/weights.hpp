#pragma once
#include <cstdint>
#include <vector>
#include "plate/bonds/parameters/horizon_parameters.hpp"

namespace plate {

/// What the energy of a point gives to one of its bonds (theory (12)): W = a theta^2 + sum (B (s xi)^2 + S (gamma
/// xi)^2), theta = sum D s xi.
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
