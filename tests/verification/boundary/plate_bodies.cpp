#include "tests/verification/boundary/plate_bodies.hpp"

#include "tests/unit/plate/edges/edge_bodies.hpp"

namespace boundary_bodies {

using geometry::Point;
using plate::SurfacePlate;

std::vector<plate::CellShare> cell_shares(bool fit) {
  const Family family = family_of(2, 3);
  std::vector<plate::CellShare> result;
  for (const auto& [away, fraction] : fit ? fitted(family, 3, [](double r) { return 1 / r; }) : family)
    result.push_back({away, fraction});
  return result;
}

LatticeLaw lattice_law(const plate::Section& section, double spacing, const std::vector<plate::CellShare>& shares) {
  double fourth = 0, mixed = 0, second = 0, long_fourth = 0;
  for (const auto& [away, share] : shares) {
    const double x = away[0], y = away[1], length = std::hypot(x, y), weight = share / length;
    fourth += weight * std::pow(x, 4) / (length * length);
    mixed += weight * std::pow(x * y, 2) / (length * length);
    second += weight * x * x;
    long_fourth += weight * std::pow(x, 4);
  }
  const double D = section.bending_stiffness(), nu = section.poisson;
  const double more = 0.75 * (1 - nu) * (fourth / (3 * mixed) - 1);  // theory (16), (17)
  return {D * (1 + more), D * (nu - more), D * (1 - nu) / 2, section.shear_stiffness(),
          long_fourth / second * spacing * spacing};
}

SurfacePlate plate_of_shares(const plate::Section& section, double spacing, const std::vector<plate::CellShare>& shares,
                             const Point& low, const Point& high, const Point& corner) {
  plate::Discretization d;
  d.spacing = spacing, d.horizon_ratio = 3, d.twist_match = plate::TwistMatch::paper;
  d.surface_correction = plate::SurfaceCorrection::arbitrary_horizon;
  auto bonds = plate::lattice_bonds(section, d, shares);
  auto body = edge_bodies::rectangle_body(low, high, corner, spacing, bonds.reach);
  return {std::move(body), std::move(bonds), corner + Point::Constant(spacing / 2)};
}

Eigen::VectorXd at_unknowns(const SurfacePlate& p, const PlateField& field) {
  Eigen::VectorXd u(p.unknowns());
  const auto put = [&](int i, const Point& at) {
    const Eigen::Vector3d v = field(at);
    u.segment<3>(3 * i) << v[0], v[2], -v[1];
  };
  for (int k = 0; k < p.body.real; ++k) put(k, p.at(k));
  for (int s = 0; s < int(p.body.surface.size()); ++s) put(p.body.real + s, p.at_surface(s));
  return u;
}

Eigen::Vector2d off(const SurfacePlate& p, const Eigen::VectorXd& u, const PlateField& field) {
  const Eigen::VectorXd exact = at_unknowns(p, field);
  Eigen::Vector2d difference(0, 0), size(0, 0);
  for (int i = 0; i < 3 * p.body.real; ++i) {
    const int of = i % 3 == 0 ? 0 : 1;
    difference[of] = std::max(difference[of], std::abs(u[i] - exact[i]));
    size[of] = std::max(size[of], std::abs(exact[i]));
  }
  for (int of = 0; of < 2; ++of)
    if (size[of] == 0) size[of] = size[1 - of];  // no rotations
  return difference.cwiseQuotient(size);
}

namespace {

/// All unknowns from those of the lower left quarter, and the places of these among all.
std::pair<plate::SparseStiffness, std::vector<Eigen::Index>> quarter(const SurfacePlate& p) {
  plate::LatticeBody::Index last = p.body.nodes[0];
  for (int k = 0; k < p.body.real; ++k) last = last.max(p.body.nodes[std::size_t(k)]);
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<Eigen::Index> own;
  const auto add = [&](int k, int face) {  // a real node, or one of its surface nodes
    const auto place = p.body.nodes[std::size_t(k)];
    if (2 * place[0] > last[0] || 2 * place[1] > last[1]) return;
    for (int c = 0; c < 3; ++c) {
      for (const int x : {0, 1})
        for (const int y : {0, 1}) {
          const int image = p.body.node({x ? last[0] - place[0] : place[0], y ? last[1] - place[1] : place[1], 0});
          int node = image;
          if (face >= 0) {
            const auto [inner, axis, side, distance] = p.body.surface[std::size_t(face)];
            node = p.body.real + p.body.surface_node(image, axis, (axis == 0 ? x : y) ? -side : side);
          }
          const double sign = (x && c == 2 ? -1 : 1) * (y && c == 1 ? -1 : 1);  // psi_x = -theta_y, psi_y = theta_x
          entries.emplace_back(3 * node + c, int(own.size()), sign);
        }
      own.push_back(3 * (face < 0 ? k : p.body.real + face) + c);
    }
  };
  for (int k = 0; k < p.body.real; ++k) add(k, -1);
  for (int s = 0; s < int(p.body.surface.size()); ++s) add(p.body.surface[std::size_t(s)].inner, s);
  plate::SparseStiffness all(p.unknowns(), Eigen::Index(own.size()));
  all.setFromTriplets(entries.begin(), entries.end());
  return {all, own};
}

}  // namespace

Eigen::VectorXd solution_of_quarter(const SurfacePlate& p, const plate::EdgeConditions& edges,
                                    const plate::AreaLoad& load) {
  const auto [right, held] = plate::edge_problem(p, edges, load);
  const auto [all, own] = quarter(p);
  std::vector<plate::PrescribedUnknown> own_held;
  for (const auto& one : held)
    if (const auto found = std::ranges::find(own, one.unknown); found != own.end())
      own_held.push_back({found - own.begin(), one.value});
  const plate::SparseStiffness folded = plate::SparseStiffness(all.transpose()) * plate::stiffness(p) * all;
  return all * edge_bodies::constrained_solution(folded, all.transpose() * right, own_held).values;
}

}  // namespace boundary_bodies
