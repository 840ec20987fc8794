#include "plate/edges/lattice_body.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plate {

namespace {

using Index = LatticeBody::Index;

Index axis_step(int axis, int side) {
  Index step(0, 0, 0);
  step[axis] = side;
  return step;
}

/// Every place from `first` to `last`, both among them.
void each_place(const Index& first, const Index& last, const std::function<void(const Index&)>& visit) {
  for (int z = first[2]; z <= last[2]; ++z)
    for (int y = first[1]; y <= last[1]; ++y)
      for (int x = first[0]; x <= last[0]; ++x) visit({x, y, z});
}

Index reach_of(int dimension, int reach) {
  Index result(0, 0, 0);
  result.head(dimension).setConstant(reach);
  return result;
}

int place_in_box(const LatticeBody& b, const Index& place) {
  const Index from = place - b.lowest;
  if ((from < 0).any() || (from >= b.extent).any()) return -1;
  return from[0] + b.extent[0] * (from[1] + b.extent[1] * from[2]);
}

void enclose(LatticeBody& b, int reach) {
  Index highest = b.nodes.front();
  b.lowest = highest;
  for (const auto& place : b.nodes) b.lowest = b.lowest.min(place), highest = highest.max(place);
  b.lowest -= reach_of(b.dimension, reach);
  b.extent = highest + reach_of(b.dimension, reach) - b.lowest + 1;
  b.at.assign(std::size_t(b.extent.prod()), -1);
  for (int k = 0; k < b.real; ++k) b.at[std::size_t(place_in_box(b, b.nodes[std::size_t(k)]))] = k;
}

void add_fictitious_nodes(LatticeBody& b, int reach) {
  std::vector<char> wanted(b.at.size(), false);
  for (int k = 0; k < b.real; ++k) {
    const Index centre = b.nodes[std::size_t(k)], away = reach_of(b.dimension, reach);
    each_place(centre - away, centre + away,
               [&](const Index& place) { wanted[std::size_t(place_in_box(b, place))] = true; });
  }
  each_place(b.lowest, b.lowest + b.extent - 1, [&](const Index& place) {
    const auto i = std::size_t(place_in_box(b, place));
    if (!wanted[i] || b.at[i] >= 0) return;
    b.at[i] = b.count();
    b.nodes.push_back(place);
  });
}

void add_surface_nodes(LatticeBody& b, const FaceDistance& distance) {
  for (int axis = 0; axis < b.dimension; ++axis)
    for (const int side : {-1, 1})
      for (int k = 0; k < b.real; ++k) {
        const Index& inner = b.nodes[std::size_t(k)];
        const int neighbour = b.node(inner + axis_step(axis, side));
        if (neighbour >= 0 && neighbour < b.real) continue;
        const double d = distance(inner, axis, side);
        if (!(d > 0 && d < 1))
          throw std::invalid_argument(fmt::format("a face {} spacings from its node is not between two nodes", d));
        b.faces[std::size_t(k)][std::size_t(2 * axis + (side > 0))] = int(b.surface.size());
        b.surface.push_back({k, axis, side, d});
      }
}

/// The surface node nearest to a fictitious one along an axis, no further than `reach` cells; -1: none.
int face_before(const LatticeBody& b, int k, int axis, int reach) {
  for (int steps = 1; steps <= reach; ++steps)
    for (const int side : {-1, 1})
      if (const int s = b.surface_node(b.node(b.nodes[std::size_t(k)] - steps * axis_step(axis, side)), axis, side);
          s >= 0)
        return s;
  return -1;
}

void add_sights(LatticeBody& b, int reach) {
  for (int k = b.real; k < b.count(); ++k) {
    std::array<int, 3> before{-1, -1, -1};
    for (int axis = 0; axis < b.dimension; ++axis) before[std::size_t(axis)] = face_before(b, k, axis, reach);
    if (std::ranges::count_if(before, [](int s) { return s >= 0; }) < 2) continue;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (before[axis] >= 0) {
        b.seen[std::size_t(k - b.real)][axis] = int(b.sights.size());
        b.sights.push_back({k, before[axis]});
      }
  }
}

}  // namespace

int LatticeBody::value(int k, int axis) const {
  const int sight = k < real ? -1 : seen[std::size_t(k - real)][std::size_t(axis)];
  return sight < 0 ? k : count() + sight;
}

int LatticeBody::node(const Index& place) const {
  const int i = place_in_box(*this, place);
  return i < 0 ? -1 : at[std::size_t(i)];
}

int LatticeBody::surface_node(int inner, int axis, int side) const {
  return inner < 0 || inner >= real ? -1 : faces[std::size_t(inner)][std::size_t(2 * axis + (side > 0))];
}

Eigen::Vector3d LatticeBody::surface_position(int s) const {
  const auto& node = surface[std::size_t(s)];
  Eigen::Vector3d x = position(node.inner);
  x[node.axis] += node.side * node.distance;
  return x;
}

LatticeBody lattice_body(int dimension, std::vector<Index> real, int reach) {
  if (dimension < 1 || dimension > 3) throw std::invalid_argument("a body has one, two or three dimensions");
  if (real.empty()) throw std::invalid_argument("a body needs a node");
  LatticeBody b;
  b.dimension = dimension;
  b.nodes = std::move(real);
  b.real = b.count();
  enclose(b, std::max(reach, 1));
  add_fictitious_nodes(b, reach);
  b.faces.assign(std::size_t(b.real), {-1, -1, -1, -1, -1, -1});
  b.seen.assign(std::size_t(b.fictitious()), {-1, -1, -1});
  return b;
}

LatticeBody lattice_body(int dimension, std::vector<Index> real, int reach, const FaceDistance& distance) {
  LatticeBody b = lattice_body(dimension, std::move(real), reach);
  add_surface_nodes(b, distance);
  add_sights(b, reach);
  return b;
}

namespace {

constexpr double on_edge = 1e-9;  // spacings: bonds that cross an edge of faces, but for rounding

/// Share of what crosses at `at` that belongs to the cell about `cell`: all inside, half on the border, none outside.
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
