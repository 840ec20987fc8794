#include "plate/edges/stiffness_rows.hpp"

#include <fmt/format.h>
#include <limits>

#include "plate/edges/boundary_conditions.hpp"
#include "plate/edges/surface_plate.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/space.hpp"

namespace plate {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Rows of what bonds do.
class Rows {
public:
  /// Adds factor times the force f of the bond from node k to node j, or a sight of them, to a row.
  void add_force(int row, int k, int j, const ActingBond& bond, double factor) {
    const double f = factor * bond.shear, half = bond.length / 2, m[] = {bond.mx, bond.my};
    values_.emplace_back(row, index_by_points(j, 0), f);
    values_.emplace_back(row, index_by_points(k, 0), -f);
    for (int b = 0; b < 2; ++b)
      for (const int end : {k, j}) values_.emplace_back(row, index_by_points(end, 1 + b), -f * half * m[b]);
  }

  /// Adds `share` times the force f and the couples m (c - lever f) of that bond to the rows of a node (theory (5)).
  void add(int node, int k, int j, const ActingBond& bond, double share, const std::array<double, 2>& lever) {
    const double m[] = {bond.mx, bond.my};
    add_force(index_by_points(node, 0), k, j, bond, share);
    for (int a = 0; a < 2; ++a) {
      const int row = index_by_points(node, 1 + a);
      add_force(row, k, j, bond, share * m[a] * (bond.length / 2 - lever[std::size_t(a)]));
      for (int b = 0; b < 2; ++b) {
        const double bend = share * bond.curvature * m[a] * m[b];
        values_.emplace_back(row, index_by_points(j, 1 + b), bend);
        values_.emplace_back(row, index_by_points(k, 1 + b), -bend);
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

/// Distance of an edge beyond the border of its cell, in spacings.
double strip(const LatticeBody& b, int surface) {
  return b.surface[std::size_t(surface)].distance - 0.5;
}

/// Faces through which a bond first leaves the plate: half through each of two at whose corner it does. Beyond corners
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

/// Values of the other end j of a bond of the plate from node k, with their shares: those seen through the faces
/// through which the bond leaves.
std::vector<std::pair<int, double>> seen(const LatticeBody& b, int k, int j) {
  if (!has_sights(b, j)) return {{j, 1}};
  std::vector<std::pair<int, double>> result;
  for (const auto& [s, share, cut] : first_crossings(b, k, j))
    result.push_back({b.value(j, b.surface[std::size_t(s)].axis), share});
  return result;
}

/// The shear force along the edge turns what lies between the border of a cell and an edge beyond it.
void add_shear_of_strip(const LatticeBody& b, int s, const LatticeBonds& family, const CrackedFamilies& cuts,
                        Rows& rows) {
  const auto& face = b.surface[std::size_t(s)];
  const int rotation = tangential_rotation(face.axis);
  if (strip(b, s) == 0) return;
  for (std::size_t i = 0; i < family.bonds.size(); ++i) {
    const int outer = b.node(b.nodes[std::size_t(face.inner)] + family.bonds[i].away);
    const ActingBond bond = acting(family, cuts, face.inner, outer, i);
    const double m = rotation == 1 ? bond.mx : bond.my;
    rows.add_force(index_by_points(b.real + s, rotation), face.inner, b.value(outer, face.axis), bond,
                   -strip(b, s) * m * bond.length / 2);
  }
}

/// Flags of nodes: true where the bonds of a node may run over places outside the plate. Elsewhere no bond crosses a
/// face.
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

PlateActions actions(const LatticeBody& b, const LatticeBonds& family, FluxRule rule, const CrackedFamilies& cuts) {
  Rows rows;
  Triplets dilatation;
  const auto near = near_edges(b, family.reach);
  for (int k = 0; k < b.count(); ++k)
    for (std::size_t i = 0; i < family.bonds.size(); ++i) {
      const int j = b.node(b.nodes[std::size_t(k)] + family.bonds[i].away);
      if (j < 0 || cuts.broken(k, i)) continue;
      const ActingBond bond = acting(family, cuts, k, j, i);
      if (k < b.real) {
        for (const auto& [value, share] : seen(b, k, j)) {
          const double by[] = {share * bond.D * bond.mx, share * bond.D * bond.my};
          for (int c = 0; c < 2; ++c) {
            dilatation.emplace_back(k, index_by_points(value, 1 + c), by[c]);
            dilatation.emplace_back(k, index_by_points(k, 1 + c), -by[c]);
          }
          rows.add(k, k, value, bond, -share, {0, 0});
        }
        if (j < b.real && !near[std::size_t(k)]) continue;
      }
      if (!b.surface.empty()) add_fluxes(b, k, j, bond, rule, rows);
    }
  for (int s = 0; s < int(b.surface.size()); ++s) add_shear_of_strip(b, s, family, cuts, rows);
  const Eigen::Index count = unknowns_per_point * (b.real + Eigen::Index(b.surface.size())), nodes = b.values();
  PlateActions result{WeightRows(b.real, unknowns_per_point * nodes),
                      SparseStiffness(count, unknowns_per_point * nodes), SparseStiffness(count, nodes)};
  result.dilatation.setFromTriplets(dilatation.begin(), dilatation.end());
  result.of_values.setFromTriplets(rows.values().begin(), rows.values().end());
  result.of_dilatation.setFromTriplets(rows.dilatation().begin(), rows.dilatation().end());
  return result;
}

PlateActions edge_actions(const LatticeBody& b, const LatticeBonds& family, const ObliqueEdges& edges,
                          const CrackedFamilies& cuts) {
  Rows rows;
  for (int k = 0; k < b.real; ++k)
    for (std::size_t i = 0; i < family.bonds.size(); ++i) {
      const int j = b.node(b.nodes[std::size_t(k)] + family.bonds[i].away);
      if (j < b.real || cuts.broken(k, i)) continue;
      const ActingBond bond = acting(family, cuts, k, j, i);
      const auto& nearest = edges.nearest[std::size_t(j - b.real)];
      const double share = 1.0 / double(nearest.size());
      for (const int s : nearest) {
        const geometry::Point at = b.position(k).head<2>();
        const geometry::Point lever = family.spacing * (at - edges.nodes[std::size_t(s)].at);  // theory (25)
        rows.add(s, k, j, bond, share, {0, 0});
        rows.add_force(index_by_points(s, 1), k, j, bond, share * lever.y());
        rows.add_force(index_by_points(s, 2), k, j, bond, -share * lever.x());
      }
    }
  const Eigen::Index count = unknowns_per_point * Eigen::Index(edges.nodes.size()), nodes = b.values();
  PlateActions result{WeightRows(0, unknowns_per_point * nodes), SparseStiffness(count, unknowns_per_point * nodes),
                      SparseStiffness(count, nodes)};
  result.of_values.setFromTriplets(rows.values().begin(), rows.values().end());
  result.of_dilatation.setFromTriplets(rows.dilatation().begin(), rows.dilatation().end());
  return result;
}

namespace {

using geometry::Point;

/// Section forces Q, M_nn and M_ns (theory (26)) of an edge per unit of a value w, theta_x or theta_y, given its
/// derivatives [1 / length] and its own value at the edge.
struct Law {
  const Section& section;
  Point n;
  Point t() const { return {-n.y(), n.x()}; }

  double shear_of_deflection(const Point& gradient) const { return section.shear_stiffness() * gradient.dot(n); }

  /// psi = (-theta_y, theta_x): `psi` is the direction of psi that the rotation is.
  double shear_of_rotation(const Point& psi) const { return -section.shear_stiffness() * psi.dot(n); }
  std::array<double, 2> moments(const Point& psi, const Point& gradient) const {
    const double D = section.bending_stiffness(), nu = section.poisson, trace = psi.dot(gradient);
    const Eigen::Matrix2d curvature = (psi * gradient.transpose() + gradient * psi.transpose()) / 2;
    return {-D * ((1 - nu) * n.dot(curvature * n) + nu * trace), -D * (1 - nu) * t().dot(curvature * n)};
  }
};

const std::array<Point, 2> psi_of_theta{Point(0, 1), Point(-1, 0)};

void add_section_forces(int s, const EdgeNode& node, const EdgeFit& deflection, const EdgeFit& rotation, int own,
                        const Section& section, double spacing, Triplets& to) {
  const Law law{section, node.normal};
  const auto directions = turning_directions(node.normal);
  const double length = node.length * spacing;
  const auto gradient = [&](const EdgeFit& fit, std::size_t i) {
    return Point(fit.terms.col(Eigen::Index(i)).head<2>() / spacing);
  };
  for (std::size_t i = 0; i < deflection.nodes.size(); ++i)
    to.emplace_back(index_by_points(s, 0), index_by_points(deflection.nodes[i], 0),
                    length * law.shear_of_deflection(gradient(deflection, i)));
  for (int c = 0; c < 2; ++c) {
    const Point& psi = psi_of_theta[std::size_t(c)];
    to.emplace_back(index_by_points(s, 0), index_by_points(own, 1 + c), length * law.shear_of_rotation(psi));
    for (std::size_t i = 0; i < rotation.nodes.size(); ++i) {
      const auto moments = law.moments(psi, gradient(rotation, i));
      const Point couple = length * (moments[0] * directions[0] + moments[1] * directions[1]);
      for (int row = 0; row < 2; ++row)
        to.emplace_back(index_by_points(s, 1 + row), index_by_points(rotation.nodes[i], 1 + c), couple[row]);
    }
  }
}

void add_row(const StiffnessRows& from, int of, double factor, int row, Triplets& to) {
  if (factor == 0) return;
  for (StiffnessRows::InnerIterator e(from, of); e; ++e) to.emplace_back(row, int(e.col()), factor * e.value());
}

/// Rows of theta where not both rotations are held: for each direction the moment or the rotation.
void add_turning_rows(const StiffnessRows& forces, int s, int k, const EdgeNode& node, const PrescribedOfNode& held,
                      double D, Triplets& to) {
  const auto directions = turning_directions(node.normal);
  for (std::size_t i = 0; i < 2; ++i) {
    const Point& along = directions[i];
    for (int r = 0; r < 2; ++r)
      for (int c = 0; c < 2; ++c)
        if (held[i + 1])
          to.emplace_back(index_by_points(k, 1 + r), index_by_points(k, 1 + c), D * along[r] * along[c]);
        else
          add_row(forces, index_by_points(s, 1 + c), along[r] * along[c], index_by_points(k, 1 + r), to);
  }
}

/// The nearest edge node that holds something; -1: none.
int nearest_held(const ObliqueEdges& edges, const std::vector<PrescribedOfNode>& held, std::size_t from,
                 bool rotations) {
  int result = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < held.size(); ++s) {
    const double away = (edges.nodes[s].at - edges.nodes[from].at).norm();
    if ((rotations ? held[s][1] && held[s][2] : held[s][0]) && away < least) result = int(s), least = away;
  }
  return result;
}

/// Bonds beyond a free edge do not sum up to its section forces part by part. What is left of them is a force on the
/// nearest node that holds the deflection, with its couple there if that holds it, and a couple on the nearest clamped
/// one: nothing in homogeneous states.
void add_left_over(const StiffnessRows& beyond, const StiffnessRows& forces, const ObliqueEdges& edges,
                   const std::vector<PrescribedOfNode>& held, int real, double spacing, Triplets& to) {
  for (std::size_t s = 0; s < held.size(); ++s) {
    const auto move = [&](int component, int target, double factor) {
      add_row(beyond, index_by_points(int(s), component), factor, target, to);
      add_row(forces, index_by_points(int(s), component), -factor, target, to);
    };
    if (const int at = held[s][0] ? -1 : nearest_held(edges, held, s, false); at >= 0) {
      const int node = real + at;
      move(0, index_by_points(node, 0), 1);
      const auto& of_node = held[std::size_t(at)];
      const Point lever = spacing * (edges.nodes[s].at - edges.nodes[std::size_t(at)].at);  // theory (25)
      if (of_node[1] && of_node[2])
        move(0, index_by_points(node, 1), lever.y()), move(0, index_by_points(node, 2), -lever.x());
    }
    const bool clamped = held[s][1] && held[s][2];
    if (const int at = clamped ? -1 : nearest_held(edges, held, s, true); at >= 0)
      for (const int c : {1, 2}) move(c, index_by_points(real + at, c), 1);
  }
}

/// Least weights of a node in its own derivatives along the normal, per spacing. Measured: 0.63, 0.25 and more on
/// squares, hexagons, Ls, holes at any angle; 0.08, 0.15 in corners of 46 degrees, where free edges had motions that
/// grow.
void check_own_weights(const ObliqueEdges& edges, const std::vector<PrescribedOfNode>& held) {
  constexpr double least_of_rotation = 0.3, least_of_deflection = 0.2;
  for (std::size_t s = 0; s < held.size(); ++s) {
    if (held[s] == PrescribedOfNode{true, true, true}) continue;
    const auto own = [&](const EdgeFit& fit) { return fit.terms.rightCols<1>().head<2>().dot(edges.nodes[s].normal); };
    const Point at = edges.units.from_lattice(edges.nodes[s].at);
    if (own(edges.rotation[s]) < least_of_rotation || (!held[s][0] && own(edges.deflection[s]) < least_of_deflection))
      throw Refused({{Subject::geometry, 0,
                      fmt::format("the corner about ({:.4g}, {:.4g}) is too sharp, or too near to a point, for surface "
                                  "nodes on edges that are not clamped: choose boundary = \"images\", or another "
                                  "spacing",
                                  at.x(), at.y())}});
  }
}

}  // namespace

std::array<Point, 2> turning_directions(const Point& n) {
  return {Point(-n.y(), n.x()), Point(-n.x(), -n.y())};
}

WeightRows section_force_rows(const LatticeBody& b, const ObliqueEdges& edges, const Section& section, double spacing) {
  Triplets entries;
  const int count = int(edges.nodes.size());
  for (int s = 0; s < count; ++s) {
    const auto i = std::size_t(s);
    add_section_forces(s, edges.nodes[i], edges.deflection[i], edges.rotation[i], b.real + s, section, spacing,
                       entries);
  }
  WeightRows rows(unknowns_per_point * count, unknowns_per_point * (b.real + count));
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

SparseStiffness oblique_stiffness(const LatticeBody& b, const LatticeBonds& bonds, const CrackedFamilies& cuts,
                                  const ObliqueEdges& edges, const Section& section,
                                  const std::vector<PrescribedOfNode>& held) {
  check_own_weights(edges, held);
  const WeightRows expanded = oblique_expansion(b, edges);
  const PlateActions inside = actions(b, bonds, FluxRule::lever, cuts);
  const WeightRows dilatation = nearest_values(b) * WeightRows(inside.dilatation * expanded);
  const auto total = [&](const PlateActions& a) {
    return StiffnessRows(a.of_values * SparseStiffness(expanded) + a.of_dilatation * SparseStiffness(dilatation));
  };
  const StiffnessRows equilibrium = total(inside), beyond = total(edge_actions(b, bonds, edges, cuts)),
                      forces = section_force_rows(b, edges, section, bonds.spacing);
  Triplets entries;
  for (int row = 0; row < unknowns_per_point * b.real; ++row) add_row(equilibrium, row, 1, row, entries);
  for (int s = 0; s < int(held.size()); ++s) {
    const auto& of_node = held[std::size_t(s)];
    const int node = b.real + s;
    add_row(of_node[0] ? beyond : forces, index_by_points(s, 0), 1, index_by_points(node, 0), entries);
    if (of_node[1] && of_node[2]) {
      add_row(beyond, index_by_points(s, 1), 1, index_by_points(node, 1), entries);
      add_row(beyond, index_by_points(s, 2), 1, index_by_points(node, 2), entries);
    } else {
      add_turning_rows(forces, s, node, edges.nodes[std::size_t(s)], of_node, section.bending_stiffness(), entries);
    }
  }
  add_left_over(beyond, forces, edges, held, b.real, bonds.spacing, entries);
  SparseStiffness result(expanded.cols(), expanded.cols());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace plate
