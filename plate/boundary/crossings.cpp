#include "plate/boundary/crossings.hpp"

#include <cmath>

namespace plate {

namespace {

using Index = LatticeBody::Index;
constexpr double on_edge = 1e-9;  // spacings: bonds that cross an edge of faces, but for rounding

/// How much of what crosses at `at` belongs to the cell about `cell`: all inside, half on the border, none outside.
double inside(double at, int cell) {
  const double away = std::abs(at - cell) - 0.5;
  return away < -on_edge ? 1 : away < on_edge ? 0.5 : 0;
}

double share(const Index& from, const Index& to, const Index& cell, int normal, double cut, FluxRule rule) {
  double crossed = 1;
  bool under_from = true, under_to = true;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == normal) continue;
    crossed *= inside(from[axis] + cut * (to[axis] - from[axis]), cell[axis]);
    under_from = under_from && cell[axis] == from[axis];
    under_to = under_to && cell[axis] == to[axis];
  }
  return rule == FluxRule::crossing_point ? crossed : (under_to ? cut : 0) + (under_from ? 1 - cut : 0);
}

}  // namespace

std::vector<Crossing> crossings(const LatticeBody& b, int inner, int outer, FluxRule rule) {
  const Index from = b.nodes[std::size_t(inner)], to = b.nodes[std::size_t(outer)];
  const Index lowest = from.min(to), highest = from.max(to);
  std::vector<Crossing> result;
  for (int axis = 0; axis < b.dimension; ++axis) {
    const int side = to[axis] > from[axis] ? 1 : -1;
    Index cell;
    for (cell[2] = lowest[2]; cell[2] <= highest[2]; ++cell[2])
      for (cell[1] = lowest[1]; cell[1] <= highest[1]; ++cell[1])
        for (cell[0] = lowest[0]; cell[0] <= highest[0]; ++cell[0]) {
          if (cell[axis] == to[axis]) continue;
          const int s = b.surface_node(b.node(cell), axis, side);
          if (s < 0) continue;
          const double cut = (std::abs(cell[axis] - from[axis]) + b.surface[std::size_t(s)].distance) /
                             std::abs(to[axis] - from[axis]);
          const double part = share(from, to, cell, axis, cut, rule);
          if (part > 0) result.push_back({s, part, cut});
        }
  }
  return result;
}

}  // namespace plate
