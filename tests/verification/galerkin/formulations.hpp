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

/// Those whose transverse shear is a field of its own, constant in each family.
const std::vector<Formulation>& assumed_shear();

/// The row of that name in formulations(); throws std::out_of_range.
const Formulation& formulation(const std::string& name);

Sparse stiffness(const Plate& plate, const Formulation& f, const Lattice& lattice);

}  // namespace galerkin_systems
