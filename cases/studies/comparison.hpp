#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cases {

/// A finished run against a reference curve.
struct ComparisonOptions {
  std::filesystem::path folder, reference;
  std::filesystem::path plot, json;     // files that are written; empty: none
  std::vector<std::string> tolerances;  // "l2=0.01"
  std::optional<double> within;         // the same for all measures
};

/// Prints how far the run is from its reference; is it within the tolerances? Throws CaseError where one says nothing,
/// and where there is nothing to compare.
bool compare(const ComparisonOptions& options);

}  // namespace cases
