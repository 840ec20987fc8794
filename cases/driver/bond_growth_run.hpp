#pragma once
#include "cases/driver/run.hpp"

namespace cases {

/// Runs a static case whose bonds break one by one. Throws as run() does.
post::Summary break_bonds(const CaseFile& file, const RunOptions& options);

}  // namespace cases
