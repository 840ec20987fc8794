#pragma once
#include <memory>
#include <string>
#include <vector>

#include "cases/runs/analyses.hpp"
#include "post/report/accuracy_search.hpp"

namespace plate {
struct Analysis;
}

namespace cases {

struct CaseFile;
struct Prepared;
struct RunOptions;

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
post::AccuracyTrial trial(ValidatedPlate& ready, const plate::Analysis& analysis, const post::SrifOptions& options);

/// Refines until every factor of the case, static or in motion, is known to srif.accuracy, or time, memory or sizes
/// end it. Returns the finest plate, solved. Throws CaseError and plate::NumericalError.
std::unique_ptr<Prepared> to_accuracy(const CaseFile& file, bool quiet);

/// Warns of lengths of the discretisation that a case gives although `by`, a key, finds them.
void warn_of_given_lengths(const CaseFile& file, const char* by, std::vector<std::string>& warnings);

/// Computes the intensity factors of a case at rest with twice the spacing, by the processes of its run: one row, or a
/// row for each of its load cases and combinations. Warns of tips at which no method has room then. Throws CaseError or
/// plate::NumericalError.
std::vector<std::vector<post::Srif>> coarser_factors(const CaseFile& file, const RunOptions& options,
                                                     std::vector<std::string>& warnings);

/// Results of a case at rest or of its frequencies by other points, by which their errors are estimated: those of bonds
/// by the Galerkin plate of 1.5 to 2.5 times the spacing, others by three times the spacing, else by 2 or 1.5 times.
/// Absent, with a warning, where no such plate can be had.
std::optional<post::OtherResults> other_results(const CaseFile& file, const RunOptions& options,
                                                std::vector<std::string>& warnings);

/// Runs a case in its folder and returns the intensity factors of all rows, or of all load cases and combinations.
std::vector<std::vector<post::Srif>> factors_of_run(const Prepared& prepared, const RunOptions& options);

}  // namespace cases
