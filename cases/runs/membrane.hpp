#pragma once
#include <vector>

#include "post/factors/tip_methods.hpp"
#include "post/files/frame.hpp"
#include "post/files/summary.hpp"

namespace plate {
class Formulation;
struct Analysis;
}  // namespace plate

namespace cases {

/// A plate in its plane, at rest under its loads.
struct MembraneResult {
  post::InPlaneFields fields;
  plate::Resultants forces;         // the membrane forces as moments (PlateLaw::membrane)
  std::vector<post::Srif> factors;  // N1 and N2 as K1 and K2
  post::MembraneSummary summary;
  std::vector<std::string> warnings;
};

/// Factors that are wanted of a plate in its plane. Without `options` none are.
struct MembraneFactorsWanted {
  const std::optional<post::SrifOptions>& options;
  const std::vector<post::TipMethods>& methods;
};

/// Solves a plate in its plane under all its loads.
/// @throws plate::NumericalError  no equilibrium within the tolerance, or a number is not finite
MembraneResult membrane_at_rest(const plate::Formulation& membrane, const plate::Analysis& analysis,
                                const MembraneFactorsWanted& wanted);

/// Results of a plate in its plane in a state of equilibrium under a load.
/// @throws plate::NumericalError  a number is not finite
MembraneResult membrane_results(const plate::Formulation& membrane, const plate::State& state,
                                const plate::Forces& load, const MembraneFactorsWanted& wanted);

}  // namespace cases
