#pragma once
#include "post/studies/compare.hpp"

namespace post {

/// A finished run against a reference curve: what there is, and what of it exceeds the tolerances.
struct ComparedRun {
  std::filesystem::path folder;
  std::vector<ComparedQuantity> rows;
  std::vector<Exceeded> above;
};

/// Throws as compare() does.
ComparedRun compared(const std::filesystem::path& folder, const std::filesystem::path& reference,
                     const Tolerances& tolerances);

std::string to_text(const ComparedRun& run);

/// Writes the curves as a drawing (SVG), or a page (.html), and all numbers as JSON, where these have a name.
void write(const ComparedRun& run, const std::filesystem::path& drawing, const std::filesystem::path& json);

}  // namespace post
