#pragma once
#include <string>

#include "tests/verification/galerkin/plate.hpp"

/// The table of plate systems that are compared with PG-CA.
namespace galerkin_systems {

struct Formulation {
  std::string name;
  std::function<System(const Lattice&, double thickness)> system;
  bool consistent;  ///< constant curvatures come out exactly
  bool stable;      ///< the spectrum holds no spurious low modes
  bool locks;       ///< at h << spacing
  Shear shear = Shear::bond;
};

const std::vector<Formulation>& formulations();

/// The row of that name; throws std::out_of_range.
const Formulation& formulation(const std::string& name);

Sparse stiffness(const Plate& plate, const Formulation& f, const Lattice& lattice);

}  // namespace galerkin_systems
