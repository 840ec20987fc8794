#include "tests/unit/plate/edges/edge_bodies.hpp"

#include <algorithm>
#include <cmath>

#include "plate/model/dense_algebra.hpp"
#include "plate/model/errors.hpp"

namespace edge_bodies {
namespace {

using geometry::Point;
constexpr double same = 1e-9;  // spacings

/// Number of the three rigid motions that leave all that is held at rest.
int rigid_motions(const SurfacePlate& p, const std::vector<PrescribedUnknown>& held) {
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(std::max<Eigen::Index>(3, Eigen::Index(held.size())), 3);
  for (std::size_t i = 0; i < held.size(); ++i) {
    const auto [point, component] = dof_by_points(held[i].unknown);
    const int node = int(point);
    const Point at = (node < p.body.real ? p.at(node) : p.at_surface(node - p.body.real)) / p.bonds.spacing;
    // w = 1; w = x, theta_y = -1; w = y, theta_x = 1
    motions.row(Eigen::Index(i)) = component == 0   ? Eigen::RowVector3d(1, at.x(), at.y())
                                   : component == 1 ? Eigen::RowVector3d(0, 0, 1)
                                                    : Eigen::RowVector3d(0, -1, 0);
  }
  return 3 - int(pseudo_inverse(motions).rank);
}

}  // namespace

LatticeBody rectangle_body(const Point& low, const Point& high, const Point& corner, double spacing, int reach) {
  const Eigen::Array2d from = (low - corner).array() / spacing - 0.5, to = (high - corner).array() / spacing - 0.5;
  const Eigen::Array2i least = (from + same).ceil().cast<int>(), most = (to - same).floor().cast<int>();
  if ((most < least).any())
    throw Refused({{Subject::spacing, 0, "no point of the lattice lies inside the plate; refine"}});
  std::vector<LatticeBody::Index> places;
  for (int y = least[1]; y <= most[1]; ++y)
    for (int x = least[0]; x <= most[0]; ++x) places.push_back({x, y, 0});
  return lattice_body(2, std::move(places), reach, [&](const LatticeBody::Index& inner, int axis, int side) {
    const double d = side < 0 ? inner[axis] - from[axis] : to[axis] - inner[axis];
    return std::min(d, 1 - same);  // an edge through the next row of points
  });
}

SurfacePlate surface_plate(const Section& section, const Discretization& d, const Point& low, const Point& high) {
  LatticeBonds bonds = lattice_bonds(section, d);
  LatticeBody body = rectangle_body(low, high, low, d.spacing, bonds.reach);
  return {std::move(body), std::move(bonds), low + Point::Constant(d.spacing / 2)};
}

ConstrainedSolution solution(const SurfacePlate& p, const EdgeConditions& edges, const AreaLoad& load) {
  const auto [right, held] = edge_problem(p, edges, load);
  if (rigid_motions(p, held) > 0) throw Refused({{Subject::support, 0, "the supports leave the plate free to move"}});
  return constrained_solution(stiffness_under(p, edges), right, held);
}

Eigen::VectorXd multiplied_solution(const SurfacePlate& p, const EdgeConditions& edges, const AreaLoad& load) {
  const auto [right, held] = edge_problem(p, edges, load);
  if (rigid_motions(p, held) > 0) throw Refused({{Subject::support, 0, "the supports leave the plate free to move"}});
  const Eigen::Index real = unknowns_per_point * p.body.real, surface = right.size() - real;
  std::vector<char> is_held(std::size_t(surface), false);
  for (const auto& one : held) is_held[std::size_t(one.unknown - real)] = true;
  const auto [stiffness, idle] = multiplied_plate(p, is_held);
  auto all_held = held;
  for (const int one : idle) all_held.push_back({one, 0});
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(stiffness.rows());
  loads.head(right.size()) = right;
  return constrained_solution(stiffness, loads, all_held).values.head(real);
}

}  // namespace edge_bodies
