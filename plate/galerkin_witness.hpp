#pragma once
#include <memory>
#include <optional>

#include "geometry/shape/outline.hpp"
#include "plate/model/state.hpp"

namespace plate {

class Formulation;
struct Problem;

/// The Galerkin plate of a problem of bonds, and its equilibrium under all loads.
struct GalerkinWitness {
  std::unique_ptr<Formulation> plate;
  State state;  // [3 x points]
};

/// With the spacing of the problem, and half of it at round holes. Nothing where the Galerkin plate cannot carry
/// the problem or finds no equilibrium. One process only.
std::optional<GalerkinWitness> galerkin_witness(const Problem& problem);

/// The largest deflection of bonds against that of the witness, each at its own points.
struct DeflectionError {
  double share;        // |w| of bonds / |w| of the witness - 1
  geometry::Point at;  // where that of the witness is largest
};

/// In plates thicker than a spacing four spacings away from point forces, where there are such points. Nothing of a
/// plate at rest under no load.
std::optional<DeflectionError> deflection_error(const Formulation& bonds, const State& state,
                                                const GalerkinWitness& witness);

}  // namespace plate
