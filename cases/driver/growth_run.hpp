#pragma once
#include "cases/driver/run.hpp"

namespace cases {

/// Runs a static case whose cracks grow. Throws as run() does.
post::Summary grow(const CaseFile& file, const RunOptions& options);

}  // namespace cases
