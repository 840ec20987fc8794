#pragma once
#include <vector>

#include "post/files/table.hpp"

namespace plate {
class Formulation;
}

namespace post {

class TipMethods;
struct SrifOptions;
struct StoredRun;

/// The rows of srif.csv, found again in the states of a finished run of this plate. Throws std::runtime_error where it
/// is a run of another plate, plate::NumericalError where a factor is not finite.
Table stored_factors(const StoredRun& run, const plate::Formulation& plate, const SrifOptions& options,
                     const std::vector<TipMethods>& methods);

}  // namespace post
