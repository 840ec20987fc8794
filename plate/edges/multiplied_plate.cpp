#include "plate/edges/multiplied_plate.hpp"

#include "plate/edges/boundary_conditions.hpp"
#include "plate/edges/surface_plate.hpp"
#include "plate/model/space.hpp"

namespace plate {

namespace {

using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Triplets = std::vector<Eigen::Triplet<double>>;

/// Values at surface nodes from those of real nodes, three each (Sca21 58).
WeightRows edge_values(const SurfacePlate& p) {
  const WeightRows rotation = surface_values(p.body, p.orders.rotation);
  return for_each_unknown({surface_values(p.body, p.orders.deflection), rotation, rotation});
}

/// Forces and fluxes from the values of real nodes: rows of real nodes, then of surface nodes (Sca21 50-57).
RowMatrix forces_and_fluxes(const SurfacePlate& p, FluxRule rule) {
  const WeightRows expanded = expansion_of_real(p);
  const PlateActions a = actions(p.body, p.bonds, rule, p.cuts);
  const WeightRows own = a.dilatation * expanded;
  const WeightRows dilatation = extrapolation(p.body, Centre::real_node, p.orders.rotation - 1) * own;
  return a.of_values * SparseStiffness(expanded) + a.of_dilatation * SparseStiffness(dilatation);
}

/// The other face of a corner's cell; -1: the cell of surface node s is no corner's.
int other_face(const LatticeBody& b, int s) {
  const auto& face = b.surface[std::size_t(s)];
  const int low = b.surface_node(face.inner, 1 - face.axis, -1);
  return low >= 0 ? low : b.surface_node(face.inner, 1 - face.axis, 1);
}

/// True for a condition that the other edge of a corner implies: where both edges hold a component, its values at the
/// one, expanded to the corner, are those at the other, so of the corner's cell one of both conditions is left out
/// (Sca21, remark 4).
bool implied(const LatticeBody& b, const std::vector<char>& held, int s, int component) {
  const int other = b.surface[std::size_t(s)].axis == 1 ? other_face(b, s) : -1;
  return other >= 0 && held[std::size_t(index_by_points(s, component))] &&
         held[std::size_t(index_by_points(other, component))];
}

void add(const RowMatrix& from, Eigen::Index of, int row, Triplets& to) {
  for (RowMatrix::InnerIterator e(from, of); e; ++e) to.emplace_back(row, int(e.col()), e.value());
}

void add_column(const RowMatrix& from, Eigen::Index of, int column, Triplets& to) {
  for (RowMatrix::InnerIterator e(from, of); e; ++e) to.emplace_back(int(e.col()), column, e.value());
}

}  // namespace

WeightRows expansion_of_real(const SurfacePlate& p) {
  check_orders(p.orders);
  const WeightRows rotation = extrapolation(p.body, Centre::real_node, p.orders.rotation);
  return for_each_unknown({extrapolation(p.body, Centre::real_node, p.orders.deflection), rotation, rotation});
}

MultipliedPlate multiplied_plate(const SurfacePlate& p, const std::vector<char>& held) {
  const RowMatrix own = forces_and_fluxes(p, p.rule), crossed = forces_and_fluxes(p, FluxRule::crossing_point),
                  values = edge_values(p);
  const int real = unknowns_per_point * p.body.real, surface = unknowns_per_point * int(p.body.surface.size()),
            count = real + 2 * surface;
  const RowMatrix assigned =
      rows_with_reactions(p, own, crossed, [&](int i) { return i >= real && held[std::size_t(i - real)]; });

  MultipliedPlate result{SparseStiffness(count, count), {}};
  Triplets entries;
  for (int row = 0; row < real; ++row) add(own, row, row, entries);
  for (int i = 0; i < surface; ++i) {
    const int value = real + i, multiplier = value + surface;
    const bool holds = held[std::size_t(i)];
    add(assigned, value, value, entries);
    if (implied(p.body, held, int(dof_by_points(i).point), int(dof_by_points(i).component))) {
      result.idle.push_back(multiplier);
      continue;
    }
    add(values, i, multiplier, entries);
    entries.emplace_back(multiplier, value, -1.0);
    if (holds) entries.emplace_back(value, multiplier, -1.0);
    add_column(holds ? values : own, holds ? i : value, multiplier, entries);
  }
  result.stiffness.setFromTriplets(entries.begin(), entries.end());
  return result;
}

double added_forces(const SparseStiffness& stiffness, const SurfacePlate& p, const Eigen::VectorXd& values,
                    double arm) {
  const Eigen::Index surface = unknowns_per_point * Eigen::Index(p.body.surface.size());
  Eigen::VectorXd multipliers = values;
  multipliers.head(values.size() - surface).setZero();
  const Eigen::VectorXd added = stiffness * multipliers;
  double sum = 0;
  for (int k = 0; k < p.body.real; ++k)
    sum += std::abs(added[index_by_points(k, 0)]) + added.segment<2>(index_by_points(k, 1)).norm() / arm;
  return sum;
}

}  // namespace plate
