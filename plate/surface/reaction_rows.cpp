#include "plate/surface/reaction_rows.hpp"

#include <array>
#include <limits>

namespace plate {

namespace {

using Index = LatticeBody::Index;
using Triplets = std::vector<Eigen::Triplet<double>>;

/// The face beside a face: the next one in its line, or the other one at a corner that points out- or inwards; -1:
/// none.
struct Beside {
  int surface;
  bool in_line;
};
Beside beside(const LatticeBody& b, int s, int towards) {
  const auto& face = b.surface[std::size_t(s)];
  const int along = 1 - face.axis;
  Index step(0, 0, 0), out(0, 0, 0);
  step[along] = towards, out[face.axis] = face.side;
  const Index& inner = b.nodes[std::size_t(face.inner)];
  if (const int next = b.surface_node(b.node(inner + step), face.axis, face.side); next >= 0) return {next, true};
  if (const int outward = b.surface_node(face.inner, along, towards); outward >= 0) return {outward, false};
  return {b.surface_node(b.node(inner + step + out), along, -towards), false};
}

/// The held face at one end of the free stretch of a component that a face lies in, and how many faces away; -1: none.
struct End {
  int surface, away;
};
End end_of_stretch(const SurfacePlate& p, const std::function<bool(int)>& held, int s, int component, int towards) {
  for (int away = 1;; ++away) {
    const auto [next, in_line] = beside(p.body, s, towards);
    if (next < 0) return {-1, away};
    if (held(3 * (p.body.real + next) + component)) return {next, away};
    if (!in_line) return {-1, away};
    s = next;
  }
}

void add(const StiffnessRows& from, int of, double factor, int row, Triplets& to) {
  for (StiffnessRows::InnerIterator e(from, of); e; ++e) to.emplace_back(row, int(e.col()), factor * e.value());
}

}  // namespace

StiffnessRows rows_with_reactions(const SurfacePlate& p, const StiffnessRows& own, const StiffnessRows& crossed,
                                  const std::function<bool(int unknown)>& held) {
  Triplets entries;
  for (int row = 0; row < int(own.rows()); ++row) add(held(row) ? crossed : own, row, 1, row, entries);
  for (int s = 0; s < int(p.body.surface.size()); ++s)
    for (int component = 0; component < 3; ++component) {
      const int row = 3 * (p.body.real + s) + component;
      if (held(row)) continue;
      const std::array<End, 2> ends{end_of_stretch(p, held, s, component, -1),
                                    end_of_stretch(p, held, s, component, 1)};
      for (std::size_t i = 0; i < 2; ++i) {
        const auto [surface, away] = ends[i];
        if (surface < 0 || away > ends[1 - i].away) continue;
        const double share = away == ends[1 - i].away ? 0.5 : 1;
        const int to = 3 * (p.body.real + surface);
        const geometry::Point lever = p.at_surface(s) - p.at_surface(surface);  // theory (25)
        const std::array<double, 3> factors{component == 0 ? 1.0 : 0.0, component == 0 ? lever.y() : component == 1,
                                            component == 0 ? -lever.x() : component == 2};
        for (int c = 0; c < 3; ++c)
          if (factors[std::size_t(c)] != 0 && held(to + c)) {
            add(crossed, row, share * factors[std::size_t(c)], to + c, entries);
            add(own, row, -share * factors[std::size_t(c)], to + c, entries);
          }
      }
    }
  StiffnessRows result(own.rows(), own.cols());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace plate
