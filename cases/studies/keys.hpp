#pragma once
#include "cases/input/keys.hpp"
#include "cases/studies/study.hpp"

namespace cases {

/// The keys of a study file; nothing is written from them.
Fields<Study> study_fields();

}  // namespace cases
