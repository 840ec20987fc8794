#pragma once
#include "cases/driver/run.hpp"

namespace cases {

/// Runs a static case with growth, of tips or of bonds, and the motion that it may end in.
post::Summary grow(const CaseFile& file, const RunOptions& options);

}  // namespace cases
