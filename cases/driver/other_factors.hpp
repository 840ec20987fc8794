#pragma once
#include <string>
#include <vector>

#include "cases/driver/run.hpp"
#include "post/factors/srif.hpp"

namespace cases {

struct Prepared;

/// Computes the intensity factors of a case at rest with twice the spacing, by the processes of its run: one row, or a
/// row for each of its load cases and combinations. Warns of tips at which no method has room then. Throws CaseError or
/// plate::NumericalError.
std::vector<std::vector<post::Srif>> coarser_factors(const CaseFile& file, const RunOptions& options,
                                                     std::vector<std::string>& warnings);

/// Runs a case in its folder and returns the intensity factors of all rows, or of all load cases and combinations.
std::vector<std::vector<post::Srif>> factors_of_run(const Prepared& prepared, const RunOptions& options);

}  // namespace cases
