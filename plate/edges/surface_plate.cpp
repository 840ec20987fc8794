#include "plate/edges/surface_plate.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "geometry/lattice/cloud.hpp"
#include "plate/edges/outlines.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/space.hpp"

namespace plate {

namespace {

using geometry::Point;

SurfacePlate oblique_plate(const Section& section, LatticeBonds bonds, const geometry::Outline& outline,
                           const Point& first) {
  const Point half(0.5, 0.5);
  std::vector<LatticeBody::Index> places;
  for (const Point& x : geometry::lattice(outline, 1).positions)
    places.push_back({int(std::floor(x.x())), int(std::floor(x.y())), 0});
  if (places.empty()) throw Refused({{Subject::spacing, 0, "no point of the lattice lies inside the plate; refine"}});
  LatticeBody body = lattice_body(2, std::move(places), bonds.reach);
  auto nodes = edge_nodes(outline);
  for (auto& node : nodes) node.at -= half;
  const Sees sees = [&](const Point& from, const Point& to) {
    return !geometry::leaves(outline, from + half, to + half);
  };
  auto edges = oblique_edges(body, std::move(nodes), sees, {first, bonds.spacing});
  SurfacePlate result{std::move(body), std::move(bonds), first};
  result.oblique.emplace(LocalEdges{std::move(edges), section});
  return result;
}

/// Adds the conditions of an edge node in any direction: held unknowns, and forces together with prescribed rotations
/// on the right side.
void add_oblique(const SurfacePlate& p, int s, const EdgeCondition& c, EdgeProblem& to) {
  const Point normal = p.normal(s);
  const int node = p.body.real + s;
  const PointValues given(c.value[0], c.value[1], c.value[2]), value = rotated(given, normal);
  const bool both = c.held[1] && c.held[2];
  if (c.held[0])
    to.held.push_back({index_by_points(node, 0), value[0]});
  else
    to.right[index_by_points(node, 0)] = p.length(s) * c.value[0];
  const auto directions = turning_directions(normal);
  for (int i = 0; i < 2; ++i) {
    if (both) to.held.push_back({index_by_points(node, 1 + i), value[1 + i]});
    const auto k = std::size_t(i);
    if (!both)
      to.right.segment<2>(index_by_points(node, 1)) +=
          directions[k] *
          (c.held[k + 1] ? -p.oblique->section.bending_stiffness() * c.value[k + 1] : p.length(s) * c.value[k + 1]);
  }
}

}  // namespace

void check_orders(const ExpansionOrders& orders) {
  if (orders.rotation < 1)
    throw std::invalid_argument("rotations beyond an edge need an expansion of order 1 at least");
  if (orders.deflection < 2 || orders.deflection < orders.rotation)
    throw std::invalid_argument(
        "deflections beyond an edge need an expansion of order 2 at least, and not below that of the rotations: "
        "otherwise fictitious nodes shear in pure bending");
}

Point SurfacePlate::at(int k) const {
  return first + bonds.spacing * body.position(k).head<2>();
}

Point SurfacePlate::at_surface(int s) const {
  if (oblique) return first + bonds.spacing * oblique->nodes[std::size_t(s)].at;
  return first + bonds.spacing * body.surface_position(s).head<2>();
}

Point SurfacePlate::normal(int s) const {
  if (oblique) return oblique->nodes[std::size_t(s)].normal;
  const auto& face = body.surface[std::size_t(s)];
  return face.side * Point::Unit(face.axis);
}

int SurfacePlate::inner(int s) const {
  if (!oblique) return body.surface[std::size_t(s)].inner;
  const auto& fit = oblique->rotation[std::size_t(s)].nodes;
  const auto away = [&](int k) {
    return k < body.real ? (body.position(k).head<2>() - oblique->nodes[std::size_t(s)].at).norm()
                         : std::numeric_limits<double>::infinity();
  };
  return *std::ranges::min_element(fit, {}, away);
}

double SurfacePlate::length(int s) const {
  return bonds.spacing * (oblique ? oblique->nodes[std::size_t(s)].length : 1);
}

double SurfacePlate::beyond(int s) const {
  if (oblique) return 0;
  return (body.surface[std::size_t(s)].distance - 0.5) * bonds.spacing;
}

SurfacePlate surface_plate(const Section& section, const Discretization& d, const geometry::Outline& outline) {
  LatticeBonds bonds = lattice_bonds(section, d);
  const geometry::LatticeUnits units{geometry::bounding_box(outline).first, d.spacing};
  const auto in_spacings = geometry::to_lattice(outline, units);
  const Point first = units.from_lattice({0.5, 0.5});
  if (!is_rectilinear(outline)) return oblique_plate(section, std::move(bonds), in_spacings, first);
  LatticeBody body = rectilinear_body(in_spacings, bonds.reach);
  return {std::move(body), std::move(bonds), first};
}

WeightRows expansion(const SurfacePlate& p) {
  if (p.oblique) return oblique_expansion(p.body, *p.oblique);
  check_orders(p.orders);
  const WeightRows deflection = extrapolation(p.body, Centre::surface_node, p.orders.deflection),
                   rotation = extrapolation(p.body, Centre::surface_node, p.orders.rotation);
  return for_each_unknown({deflection, rotation, rotation});
}

SparseStiffness stiffness(const SurfacePlate& p) {
  const WeightRows expanded = expansion(p);
  const PlateActions a = actions(p.body, p.bonds, p.rule, p.cuts);
  const WeightRows own = a.dilatation * expanded;
  const WeightRows dilatation = extrapolation(p.body, Centre::real_node, p.orders.rotation - 1) * own;
  return a.of_values * SparseStiffness(expanded) + a.of_dilatation * SparseStiffness(dilatation);
}

SparseStiffness stiffness_with_reactions(const SurfacePlate& plate, const std::function<bool(int unknown)>& held) {
  SurfacePlate by_crossings = plate;
  by_crossings.rule = FluxRule::crossing_point;
  return rows_with_reactions(plate, stiffness(plate), stiffness(by_crossings), held);
}

EdgeProblem edge_problem(const SurfacePlate& p, const EdgeConditions& edges, const AreaLoad& load) {
  const double spacing = p.bonds.spacing;
  EdgeProblem result{Eigen::VectorXd::Zero(p.unknowns()), {}};
  for (int k = 0; k < p.body.real; ++k)
    result.right.segment<unknowns_per_point>(index_by_points(k, 0)) = spacing * spacing * load(p.at(k));
  for (int s = 0; s < p.surfaces(); ++s) {
    if (p.oblique) {
      add_oblique(p, s, edges(p.at_surface(s), p.normal(s)), result);
      continue;
    }
    const int axis = p.body.surface[std::size_t(s)].axis, node = p.body.real + s;
    const Point at = p.at_surface(s), normal = p.normal(s);
    const EdgeCondition c = edges(at, normal);
    const PointValues given(c.value[0], c.value[1], c.value[2]);
    const PointValues value = rotated(given, normal), force = spacing * conjugate(given, normal);
    const double strip = p.beyond(s);
    PointValues on_strip = strip * spacing * load(at - strip / 2 * normal);
    const Point lever = -strip / 2 * normal;  // theory (25)
    on_strip += on_strip[0] * PointValues(0, lever.y(), -lever.x());
    const int components[] = {0, normal_rotation(axis), tangential_rotation(axis)};
    for (std::size_t i = 0; i < unknowns_per_point; ++i) {
      const int unknown = index_by_points(node, components[i]);
      if (c.held[i])
        result.held.push_back({unknown, value[components[i]]});
      else
        result.right[unknown] = force[components[i]] + on_strip[components[i]];
    }
  }
  return result;
}

SparseStiffness stiffness_under(const SurfacePlate& p, const EdgeConditions& edges) {
  if (!p.oblique) return stiffness(p);
  std::vector<PrescribedOfNode> held;
  for (int s = 0; s < p.surfaces(); ++s) held.push_back(edges(p.at_surface(s), p.normal(s)).held);
  return oblique_stiffness(p.body, p.bonds, p.cuts, *p.oblique, p.oblique->section, held);
}

namespace {

using Index = LatticeBody::Index;
using Triplets = std::vector<Eigen::Triplet<double>>;

/// The face beside a face: the next one in its line, or the other one at a corner that points out- or inwards; -1:
/// none.
struct NextFace {
  int surface;
  bool in_line;
};
NextFace next_face(const LatticeBody& b, int s, int towards) {
  const auto& face = b.surface[std::size_t(s)];
  const int along = 1 - face.axis;
  Index step(0, 0, 0), out(0, 0, 0);
  step[along] = towards, out[face.axis] = face.side;
  const Index& inner = b.nodes[std::size_t(face.inner)];
  if (const int next = b.surface_node(b.node(inner + step), face.axis, face.side); next >= 0) return {next, true};
  if (const int outward = b.surface_node(face.inner, along, towards); outward >= 0) return {outward, false};
  return {b.surface_node(b.node(inner + step + out), along, -towards), false};
}

/// Held face at one end of the free part of a component that a face lies in, and how many faces away; -1: none.
struct End {
  int surface, away;
};
End end_of_free_faces(const SurfacePlate& p, const std::function<bool(int)>& held, int s, int component, int towards) {
  for (int away = 1;; ++away) {
    const auto [next, in_line] = next_face(p.body, s, towards);
    if (next < 0) return {-1, away};
    if (held(index_by_points(p.body.real + next, component))) return {next, away};
    if (!in_line) return {-1, away};
    s = next;
  }
}

void copy_row(const StiffnessRows& from, int of, double factor, int row, Triplets& to) {
  for (StiffnessRows::InnerIterator e(from, of); e; ++e) to.emplace_back(row, int(e.col()), factor * e.value());
}

}  // namespace

StiffnessRows rows_with_reactions(const SurfacePlate& p, const StiffnessRows& own, const StiffnessRows& crossed,
                                  const std::function<bool(int unknown)>& held) {
  Triplets entries;
  for (int row = 0; row < int(own.rows()); ++row) copy_row(held(row) ? crossed : own, row, 1, row, entries);
  for (int s = 0; s < int(p.body.surface.size()); ++s)
    for (int component = 0; component < unknowns_per_point; ++component) {
      const int row = index_by_points(p.body.real + s, component);
      if (held(row)) continue;
      const std::array<End, 2> ends{end_of_free_faces(p, held, s, component, -1),
                                    end_of_free_faces(p, held, s, component, 1)};
      for (std::size_t i = 0; i < 2; ++i) {
        const auto [surface, away] = ends[i];
        if (surface < 0 || away > ends[1 - i].away) continue;
        const double share = away == ends[1 - i].away ? 0.5 : 1;
        const int to = p.body.real + surface;
        const geometry::Point lever = p.at_surface(s) - p.at_surface(surface);  // theory (25)
        const std::array<double, unknowns_per_point> factors{component == 0 ? 1.0 : 0.0,
                                                             component == 0 ? lever.y() : component == 1,
                                                             component == 0 ? -lever.x() : component == 2};
        for (int c = 0; c < unknowns_per_point; ++c)
          if (factors[std::size_t(c)] != 0 && held(index_by_points(to, c))) {
            copy_row(crossed, row, share * factors[std::size_t(c)], index_by_points(to, c), entries);
            copy_row(own, row, -share * factors[std::size_t(c)], index_by_points(to, c), entries);
          }
      }
    }
  StiffnessRows result(own.rows(), own.cols());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

EdgeSpectrum spectrum(const SurfacePlate& p, const EdgeConditions& edges, double thickness) {
  constexpr double rounding = 1e-10;  // of the largest; rigid motions of a free plate: 1e-15 to 1e-13
  const auto held = edge_problem(p, edges, [](const geometry::Point&) { return PointValues(0, 0, 0); }).held;
  std::vector<char> is_held(std::size_t(p.unknowns()), false);
  for (const auto& one : held) is_held[std::size_t(one.unknown)] = true;
  std::vector<Eigen::Index> surface;
  for (Eigen::Index i = unknowns_per_point * p.body.real; i < p.unknowns(); ++i)
    if (!is_held[std::size_t(i)]) surface.push_back(i);
  const Eigen::MatrixXd K = stiffness_under(p, edges);
  const Eigen::Index n = unknowns_per_point * p.body.real;
  Eigen::MatrixXd inside = K.topLeftCorner(n, n);
  if (!surface.empty()) {
    const Eigen::MatrixXd follow =
        Eigen::MatrixXd(K(surface, surface)).partialPivLu().solve(K(surface, Eigen::seqN(0, n)));
    inside -= K(Eigen::seqN(0, n), surface) * follow;
  }
  const double rotary = std::sqrt(12.0) / thickness;  // mass per area: 1, h^2 / 12, h^2 / 12
  const Eigen::VectorXd scale = PointValues(1, rotary, rotary).replicate(p.body.real, 1);
  const Eigen::MatrixXd scaled = scale.asDiagonal() * inside * scale.asDiagonal();
  const Eigen::VectorXcd values = scaled.eigenvalues();
  const double largest = values.cwiseAbs().maxCoeff();
  EdgeSpectrum result{values.real().minCoeff() / largest, 0, 0};
  for (const auto& value : values) {
    const auto lambda = std::abs(value) < rounding * largest ? 0 : value;
    result.negative += lambda.real() < 0;
    result.asymmetry = std::max(result.asymmetry, std::abs(std::sqrt(lambda).imag()) / std::sqrt(largest));
  }
  return result;
}

}  // namespace plate
