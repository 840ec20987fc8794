#pragma once
#include <memory>
#include <vector>

#include "post/files/summary.hpp"

namespace cases {

struct CaseFile;
struct Prepared;

/// A plate whose discretisation was found, and how.
struct Accurate {
  std::unique_ptr<Prepared> plate;  // the finest, solved
  post::AccuracySummary found;
  std::vector<std::vector<post::Srif>> rows;  // at all times: of each tip what all tend to, then of the finest
};

/// Refines until every factor of the case, static or in motion, is known to srif.accuracy, or time, memory or sizes
/// end it. Throws CaseError and plate::NumericalError.
Accurate to_accuracy(const CaseFile& file, bool quiet);

}  // namespace cases
