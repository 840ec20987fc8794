#pragma once
#include <vector>

namespace plate {

struct Problem;

/// What one of some processes will have of a Galerkin plate that they share.
struct ForetoldPart {
  double points = 0, seen = 0;  // its own; with others' that it has copies of
  double neighbours = 0;        // whose points these are
  bool whole = false;           // makes all points before it keeps these
};

/// Told without processes: the shares of a lattice by its rows, of graded points by the points themselves.
/// @throws Refused  too few points, or rows of them, for so many processes
std::vector<ForetoldPart> foretold_parts(const Problem& problem, int processes);

}  // namespace plate
