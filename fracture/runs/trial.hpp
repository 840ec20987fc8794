#pragma once
#include "fracture/runs/ready.hpp"
#include "post/studies/accuracy/search.hpp"

namespace plate {
struct Analysis;
}

namespace fracture {

/// The factors of a plate in equilibrium, and the equilibrium. `when` it is sought, for what is thrown where it is not
/// found: NumericalError.
struct FactorsAtRest {
  plate::StaticResult equilibrium;
  std::vector<post::Srif> factors;
};
FactorsAtRest factors_at_rest(const plate::Formulation& plate, const std::vector<post::TipMethods>& methods,
                              const plate::Analysis& analysis, const post::SrifOptions& options,
                              const std::string& when);

/// Solves a plate on the way to a stated accuracy; its solution stays with it. Throws NumericalError.
post::AccuracyTrial trial(Ready& ready, const plate::Analysis& analysis, const post::SrifOptions& options);

}  // namespace fracture
