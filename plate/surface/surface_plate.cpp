#include "plate/surface/surface_plate.hpp"

#include <stdexcept>
#include "geometry/lattice/cloud.hpp"
#include "plate/model/algebra/dense.hpp"
#include "plate/model/refused.hpp"
#include "plate/surface/reaction_rows.hpp"
#include "plate/surface/rectilinear.hpp"

namespace plate {

namespace {

using geometry::Point;
constexpr double same = 1e-9;  // spacings

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
  return first + bonds.spacing * body.surface_position(s).head<2>();
}

Point SurfacePlate::normal(int s) const {
  const auto& face = body.surface[std::size_t(s)];
  return face.side * Point::Unit(face.axis);
}

double SurfacePlate::beyond(int s) const {
  return (body.surface[std::size_t(s)].distance - 0.5) * bonds.spacing;
}

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

SurfacePlate surface_plate(const Section& section, const Discretization& d, const geometry::Outline& outline) {
  LatticeBonds bonds = lattice_bonds(section, d);
  const geometry::LatticeUnits units{geometry::bounding_box(outline).first, d.spacing};
  LatticeBody body = rectilinear_body(geometry::to_lattice(outline, units), bonds.reach);
  return {std::move(body), std::move(bonds), units.from_lattice({0.5, 0.5})};
}

WeightRows expansion(const SurfacePlate& p) {
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
  for (int k = 0; k < p.body.real; ++k) result.right.segment<3>(3 * k) = spacing * spacing * load(p.at(k));
  for (int s = 0; s < int(p.body.surface.size()); ++s) {
    const int axis = p.body.surface[std::size_t(s)].axis, row = 3 * (p.body.real + s);
    const Point at = p.at_surface(s), normal = p.normal(s);
    const EdgeCondition c = edges(at, normal);
    const Eigen::Vector3d given(c.value[0], c.value[1], c.value[2]);
    const Eigen::Vector3d value = rotated(given, normal), force = spacing * conjugate(given, normal);
    const double strip = p.beyond(s);
    Eigen::Vector3d on_strip = strip * spacing * load(at - strip / 2 * normal);
    const Point lever = -strip / 2 * normal;  // theory (25)
    on_strip += on_strip[0] * Eigen::Vector3d(0, lever.y(), -lever.x());
    const int components[] = {0, normal_rotation(axis), tangential_rotation(axis)};
    for (std::size_t i = 0; i < 3; ++i) {
      const int unknown = row + components[i];
      if (c.held[i])
        result.held.push_back({unknown, value[components[i]]});
      else
        result.right[unknown] = force[components[i]] + on_strip[components[i]];
    }
  }
  return result;
}

int rigid_motions(const SurfacePlate& p, const std::vector<HeldUnknown>& held) {
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(std::max<Eigen::Index>(3, Eigen::Index(held.size())), 3);
  for (std::size_t i = 0; i < held.size(); ++i) {
    const int node = int(held[i].unknown) / 3, component = int(held[i].unknown) % 3;
    const Point at = (node < p.body.real ? p.at(node) : p.at_surface(node - p.body.real)) / p.bonds.spacing;
    // w = 1; w = x, theta_y = -1; w = y, theta_x = 1
    motions.row(Eigen::Index(i)) = component == 0   ? Eigen::RowVector3d(1, at.x(), at.y())
                                   : component == 1 ? Eigen::RowVector3d(0, 0, 1)
                                                    : Eigen::RowVector3d(0, -1, 0);
  }
  return 3 - int(pseudo_inverse(motions).rank);
}

HeldSolution solution(const SurfacePlate& p, const EdgeConditions& edges, const AreaLoad& load) {
  const auto [right, held] = edge_problem(p, edges, load);
  if (rigid_motions(p, held) > 0) throw Refused({{Subject::support, 0, "the supports leave the plate free to move"}});
  return solution_held(stiffness(p), right, held);
}

}  // namespace plate
