#pragma once
#include "geometry/families.hpp"

namespace geometry {

/// Families in the form that a vector unit likes: neighbouring points whose families look alike (same bond vectors,
/// neighbours at the same distance in the numbering) share one pattern, and follow each other in runs. On a lattice
/// numbered by rows, a run is a piece of a row; any cloud has runs, if only of one point.
struct FamilyRuns {
  struct Bond {
    std::uint32_t vector_id;
    std::int32_t step;  // neighbour = point + step
  };
  struct Run {
    std::uint32_t first_point, length, pattern;
  };

  std::vector<Run> runs;                   // ascending; every point is in one
  std::vector<Bond> bonds;                 // of all patterns, one after the other
  std::vector<std::size_t> pattern_first;  // bonds of pattern p: pattern_first[p] ... pattern_first[p + 1] - 1
};

/// Runs of at most `longest` points, so that they can be shared out among threads.
FamilyRuns family_runs(const Families& families, std::uint32_t longest);

}  // namespace geometry
