#pragma once
#include "cases/keys.hpp"
#include "cases/study.hpp"

namespace cases {

/// The keys of a study file; nothing is written from them.
Fields<Study> study_fields();

}  // namespace cases
