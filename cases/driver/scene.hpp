#pragma once
#include "cases/driver/assembly.hpp"
#include "post/files/summary.hpp"

namespace cases {

/// The parts of the program that this case uses, each with the memory that it takes. What is not listed is not there.
std::vector<post::ScenePart> scene(const Case& content, const Assembly& assembly);

/// What is known of a run before it.
post::Summary about(const Case& content, const Assembly& assembly);

}  // namespace cases
