#pragma once
#include "plate/bonds/parameters/weights.hpp"
#include "plate/formulation/bond_law.hpp"
#include "plate/model/state.hpp"

namespace plate {

/// A bond of a family that is kept for itself.
struct OwnBond {
  std::uint32_t neighbour;
  double mx, my, length;  // as in BondShape
  BondWeights weights;
};

/// The family of one point with its own weights: what its point stores (theory (12)).
struct OwnFamily {
  std::uint32_t point = 0;
  double area = 0;  // [length^2]
  double a = 0;     // [force length]
  std::vector<OwnBond> bonds;
};

/// Energy that the point stores, A W, as the bilinear form of two states; of one state given twice it is its energy.
double energy(const OwnFamily& family, const State& a, const State& b);

/// Adds `share` times the forces of that energy, -dU/d(state), to the point and its neighbours.
void add_force(const OwnFamily& family, const State& state, double share, Forces& forces);

}  // namespace plate
