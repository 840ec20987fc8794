#pragma once
#include "cases/input/case_file.hpp"

namespace cases {

/// The case in the other formulation, without files for fields. Settings that only one formulation has take their
/// defaults. Throws CaseError where the case cannot be stated in it.
CaseFile in_other_formulation(const CaseFile& file);

}  // namespace cases
