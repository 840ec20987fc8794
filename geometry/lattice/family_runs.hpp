#pragma once
#include "geometry/lattice/families.hpp"

namespace geometry {

/// Families in the form that a vector unit likes: neighbouring points whose families look alike (same kind, neighbours
/// of the same kinds at the same distances in the numbering) share one pattern, and follow each other in runs. On a
/// lattice numbered by rows, a run is a piece of a row; any cloud has runs, if only of one point.
struct FamilyRuns {
  struct Run {
    std::uint32_t first_point, length, pattern;
  };

  std::vector<Run> runs;               // ascending; every point is in one
  std::vector<std::uint32_t> example;  // a point of every pattern
};

/// Runs of at most `longest` points, so that they can be shared out among threads. `kind`: a number for every point,
/// the same only for points with equal bond vectors. `block`: a number for every point, where no run is to hold points
/// with different ones.
FamilyRuns family_runs(const Families& families, const std::vector<std::uint32_t>& kind, std::uint32_t longest,
                       const std::vector<std::uint32_t>& block = {});

}  // namespace geometry
