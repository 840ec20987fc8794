#pragma once
#include <string>

namespace post {

struct CurvePlot;

/// The page of a comparison with reference curves: `table`, the error norms as they are printed, and the curves over
/// each other.
std::string comparison_page(const CurvePlot& plot, const std::string& table);

}  // namespace post
