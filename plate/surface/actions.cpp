#include "plate/surface/actions.hpp"

#include "plate/surface/edges.hpp"

namespace plate {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Rows of what bonds do.
class Rows {
public:
  /// Adds factor times the force f of the bond from node k to node j, or a sight of them, to a row.
  void add_force(int row, int k, int j, const ActingBond& bond, double factor) {
    const double f = factor * bond.shear, half = bond.length / 2, m[] = {bond.mx, bond.my};
    values_.emplace_back(row, 3 * j, f);
    values_.emplace_back(row, 3 * k, -f);
    for (int b = 0; b < 2; ++b)
      for (const int end : {k, j}) values_.emplace_back(row, 3 * end + 1 + b, -f * half * m[b]);
  }

  /// Adds `share` times the force f and the couples m (c - lever f) of that bond to the rows of a node (theory (5)).
  void add(int node, int k, int j, const ActingBond& bond, double share, const std::array<double, 2>& lever) {
    const double m[] = {bond.mx, bond.my};
    add_force(3 * node, k, j, bond, share);
    for (int a = 0; a < 2; ++a) {
      const int row = 3 * node + 1 + a;
      add_force(row, k, j, bond, share * m[a] * (bond.length / 2 - lever[std::size_t(a)]));
      for (int b = 0; b < 2; ++b) {
        const double bend = share * bond.curvature * m[a] * m[b];
        values_.emplace_back(row, 3 * j + 1 + b, bend);
        values_.emplace_back(row, 3 * k + 1 + b, -bend);
      }
      dilatation_.emplace_back(row, k, share * bond.own_couple * m[a]);
      dilatation_.emplace_back(row, j, share * bond.other_couple * m[a]);
    }
  }
  const Triplets& values() const { return values_; }
  const Triplets& dilatation() const { return dilatation_; }

private:
  Triplets values_, dilatation_;
};

/// How far an edge is beyond the border of its cell, in spacings.
double strip(const LatticeBody& b, int surface) {
  return b.surface[std::size_t(surface)].distance - 0.5;
}

/// Through which faces a bond leaves the plate first: half through each of two at whose corner it does. Beyond corners
/// that point inwards edges off the lattice cross or leave a gap: one face of those that it crosses, or both.
std::vector<Crossing> first_crossings(const LatticeBody& b, int k, int j) {
  auto left = crossings(b, k, j, FluxRule::crossing_point);
  if (left.empty())
    for (const int axis : {0, 1})
      left.push_back({b.sights[std::size_t(b.value(j, axis) - b.count())].surface, 0.5, 0.5});
  const double first = std::ranges::min(left, {}, &Crossing::cut).cut;
  std::erase_if(left, [&](const Crossing& one) { return one.cut > first + 1e-9; });
  double sum = 0;
  for (const auto& one : left) sum += one.share;
  for (auto& one : left) one.share /= sum;
  return left;
}

bool has_sights(const LatticeBody& b, int node) {
  return b.value(node, 0) != node || b.value(node, 1) != node;
}

void add_fluxes(const LatticeBody& b, int k, int j, const ActingBond& bond, FluxRule rule, Rows& rows) {
  const auto away = b.nodes[std::size_t(j)] - b.nodes[std::size_t(k)];
  const bool once = rule == FluxRule::crossing_point && k < b.real && has_sights(b, j);
  for (const auto& [s, share, cut] : once ? first_crossings(b, k, j) : crossings(b, k, j, rule)) {
    const int axis = b.surface[std::size_t(s)].axis;
    std::array<double, 2> lever{cut * bond.length, cut * bond.length};
    lever[std::size_t(tangential_rotation(axis) - 1)] -= strip(b, s) / std::max(1, std::abs(away[axis])) * bond.length;
    rows.add(b.real + s, b.value(k, axis), b.value(j, axis), bond, share, lever);
  }
}

/// What the other end of a bond of the plate is worth, by shares: seen through the faces that the bond leaves through.
std::vector<std::pair<int, double>> seen(const LatticeBody& b, int k, int j) {
  if (!has_sights(b, j)) return {{j, 1}};
  std::vector<std::pair<int, double>> result;
  for (const auto& [s, share, cut] : first_crossings(b, k, j))
    result.push_back({b.value(j, b.surface[std::size_t(s)].axis), share});
  return result;
}

/// The shear force along the edge turns what lies between the border of a cell and an edge beyond it.
void add_shear_of_strip(const LatticeBody& b, int s, const LatticeBonds& family, const CutFamilies& cuts, Rows& rows) {
  const auto& face = b.surface[std::size_t(s)];
  const int rotation = tangential_rotation(face.axis);
  if (strip(b, s) == 0) return;
  for (std::size_t i = 0; i < family.bonds.size(); ++i) {
    const int outer = b.node(b.nodes[std::size_t(face.inner)] + family.bonds[i].away);
    const ActingBond bond = acting(family, cuts, face.inner, outer, i);
    const double m = rotation == 1 ? bond.mx : bond.my;
    rows.add_force(3 * (b.real + s) + rotation, face.inner, b.value(outer, face.axis), bond,
                   -strip(b, s) * m * bond.length / 2);
  }
}

/// Of nodes: are some places that their bonds may run over outside the plate? Elsewhere no bond crosses a face.
std::vector<char> near_edges(const LatticeBody& b, int reach) {
  std::vector<char> result(std::size_t(b.count()), false);
  for (const auto& face : b.surface) {
    const auto& at = b.nodes[std::size_t(face.inner)];
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x)
        if (const int k = b.node(at + LatticeBody::Index{x, y, 0}); k >= 0) result[std::size_t(k)] = true;
  }
  return result;
}

}  // namespace

PlateActions actions(const LatticeBody& b, const LatticeBonds& family, FluxRule rule, const CutFamilies& cuts) {
  Rows rows;
  Triplets dilatation;
  const auto near = near_edges(b, family.reach);
  for (int k = 0; k < b.count(); ++k)
    for (std::size_t i = 0; i < family.bonds.size(); ++i) {
      const int j = b.node(b.nodes[std::size_t(k)] + family.bonds[i].away);
      if (j < 0 || cuts.severed(k, i)) continue;
      const ActingBond bond = acting(family, cuts, k, j, i);
      if (k < b.real) {
        for (const auto& [value, share] : seen(b, k, j)) {
          const double by[] = {share * bond.D * bond.mx, share * bond.D * bond.my};
          for (int c = 0; c < 2; ++c) {
            dilatation.emplace_back(k, 3 * value + 1 + c, by[c]);
            dilatation.emplace_back(k, 3 * k + 1 + c, -by[c]);
          }
          rows.add(k, k, value, bond, -share, {0, 0});
        }
        if (j < b.real && !near[std::size_t(k)]) continue;
      }
      if (!b.surface.empty()) add_fluxes(b, k, j, bond, rule, rows);
    }
  for (int s = 0; s < int(b.surface.size()); ++s) add_shear_of_strip(b, s, family, cuts, rows);
  const Eigen::Index count = 3 * (b.real + Eigen::Index(b.surface.size())), nodes = b.values();
  PlateActions result{WeightRows(b.real, 3 * nodes), SparseStiffness(count, 3 * nodes), SparseStiffness(count, nodes)};
  result.dilatation.setFromTriplets(dilatation.begin(), dilatation.end());
  result.of_values.setFromTriplets(rows.values().begin(), rows.values().end());
  result.of_dilatation.setFromTriplets(rows.dilatation().begin(), rows.dilatation().end());
  return result;
}

PlateActions edge_actions(const LatticeBody& b, const LatticeBonds& family, const ObliqueEdges& edges,
                          const CutFamilies& cuts) {
  Rows rows;
  for (int k = 0; k < b.real; ++k)
    for (std::size_t i = 0; i < family.bonds.size(); ++i) {
      const int j = b.node(b.nodes[std::size_t(k)] + family.bonds[i].away);
      if (j < b.real || cuts.severed(k, i)) continue;
      const ActingBond bond = acting(family, cuts, k, j, i);
      const auto& nearest = edges.nearest[std::size_t(j - b.real)];
      const double share = 1.0 / double(nearest.size());
      for (const int s : nearest) {
        const geometry::Point at = b.position(k).head<2>();
        const geometry::Point lever = family.spacing * (at - edges.nodes[std::size_t(s)].at);  // theory (25)
        rows.add(s, k, j, bond, share, {0, 0});
        rows.add_force(3 * s + 1, k, j, bond, share * lever.y());
        rows.add_force(3 * s + 2, k, j, bond, -share * lever.x());
      }
    }
  const Eigen::Index count = 3 * Eigen::Index(edges.nodes.size()), nodes = b.values();
  PlateActions result{WeightRows(0, 3 * nodes), SparseStiffness(count, 3 * nodes), SparseStiffness(count, nodes)};
  result.of_values.setFromTriplets(rows.values().begin(), rows.values().end());
  result.of_dilatation.setFromTriplets(rows.dilatation().begin(), rows.dilatation().end());
  return result;
}

}  // namespace plate
