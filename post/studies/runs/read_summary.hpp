#pragma once
#include <filesystem>
#include <optional>

#include "post/files/summary.hpp"

namespace post {

/// What summary.json of a finished run says of formulation, outcome, points, bonds, iterations, seconds, factors
/// (without rings and fits), peaks, frequencies, growth, warnings, version and digest. Nothing where there is no such
/// file, or it is not whole.
std::optional<Summary> read_summary(const std::filesystem::path& path);

}  // namespace post
