#pragma once
#include <variant>
#include <vector>

#include "plate/formulation/discretised.hpp"
#include "plate/formulation/layout.hpp"
#include "plate/galerkin/families.hpp"
#include "plate/galerkin/part_of_cells.hpp"
#include "plate/model/errors.hpp"

namespace plate {

struct Problem;

/// The points and cells of a plate with all spacings `factor` times as wide. Throws std::invalid_argument where cracks
/// and edges are too close to each other for them.
geometry::Tessellation cells_of(const Problem& problem, const std::vector<geometry::CrackPath>& paths, double factor);

/// Returns the cells of cells_of(), or the reason why there are none: cracks and edges are too close to each other, or
/// the points too many to be numbered. Where ranks share the cells and they are on a lattice: the lattice that
/// describes them.
std::variant<GlobalCells, Refusal> possible_cells(const Problem& problem, const std::vector<geometry::CrackPath>& paths,
                                                  double factor, bool distributed);
/// Returns what possible_cells() does.
/// @throws Refused  where there are none
GlobalCells global_cells_of(const Problem& problem, const std::vector<geometry::CrackPath>& paths, double factor,
                            bool distributed);
/// Cells of the plate itself (factor 1). `distributed`: true where ranks share the cells, or are to.
/// @throws Refused  cracks and edges are too close to each other, or the points too many to be numbered
GlobalCells required_cells(const Problem& problem, const std::vector<geometry::CrackPath>& paths, bool distributed);

/// The share of what lies about a place that other points there stand for: both faces of a crack, parted from each
/// other.
std::vector<double> cut_share(const geometry::Tessellation& cells, const std::vector<double>& areas);

/// A Galerkin plate before its forces; where the plate is distributed, the part of this one.
struct DiscretisedPart {
  Layout layout;
  geometry::Tessellation cells;
  GalerkinFamilies families;
  // where the plate is distributed:
  std::vector<std::uint32_t> number;        // global, of every point
  std::vector<std::uint32_t> column_block;  // of GalerkinOperator
};

/// Discretises the plate. Where ranks share a lattice, each rank makes the points and cells about its own part, with
/// their supports and nodal forces, and keeps its part; with graded points every rank makes those of the global plate.
/// @throws Refused
DiscretisedPart discretised_part(const Problem& problem, std::vector<geometry::CrackPath> paths, GlobalCells whole,
                                 const Communicator& all, Stopwatch& stopwatch);

/// Estimated size of one rank's part of a distributed Galerkin plate.
struct PartEstimate {
  double points = 0, seen = 0;  // its own; with others' as ghosts
  double neighbours = 0;        // whose points these are
  bool whole = false;           // makes all points before it keeps these
};

/// Estimates the parts of a distributed plate on one process: the shares of a lattice by its rows, of graded points by
/// the points themselves.
/// @throws Refused  too few points, or rows of them, for so many processes
std::vector<PartEstimate> estimated_parts(const Problem& problem, int processes);

}  // namespace plate
