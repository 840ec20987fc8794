#pragma once
#include "geometry/cells/tessellation.hpp"
#include "plate/formulation/layout.hpp"
#include "plate/formulation/stopwatch.hpp"
#include "plate/galerkin/families.hpp"

namespace plate {

/// The points and cells of a plate with all spacings `factor` times as wide. Throws std::invalid_argument where cracks
/// and edges are too close to each other for them.
geometry::Tessellation cells_of(const Problem& problem, const std::vector<geometry::CrackPath>& paths, double factor);

/// The share of what lies about a place that other points there stand for: both faces of a crack, parted from each
/// other.
std::vector<double> cut_share(const geometry::Tessellation& cells, const std::vector<double>& areas);

/// A Galerkin plate before its forces; where several processes share it, the part of this one.
struct LaidOut {
  Layout layout;
  geometry::Tessellation cells;
  GalerkinFamilies families;
  // where processes share the plate:
  std::vector<std::uint32_t> number;   // of every point in the whole
  std::vector<std::uint32_t> stretch;  // of GalerkinOperator
};

/// Every process makes the points and cells of the whole plate, its supports and its nodal forces, and keeps its part.
/// @throws Refused
LaidOut laid_out(const Problem& problem, std::vector<geometry::CrackPath> paths, geometry::Tessellation whole,
                 Stopwatch& stopwatch);

}  // namespace plate
