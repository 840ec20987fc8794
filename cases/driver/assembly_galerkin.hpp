#pragma once
#include "cases/driver/assembly.hpp"
#include "plate/galerkin/levels.hpp"

namespace cases {

/// Throws CaseError as assemble() does, and where edges and cracks cross within a spacing.
Assembly assemble_galerkin(const CaseFile& file, std::vector<geometry::CrackPath> paths, Stopwatch& stopwatch);

/// The same plate on points two, four, ... times as far apart, as far as it has the same pieces there and the one
/// before still has many points; for GalerkinLevels.
std::vector<plate::GalerkinLevel> coarser_plates(const Case& c, const Assembly& assembly);

}  // namespace cases
