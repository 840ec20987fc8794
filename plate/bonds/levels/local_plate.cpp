#include "plate/bonds/levels/local_plate.hpp"

#include <cmath>

#include "plate/bonds/parameters/position_aware.hpp"
#include "plate/model/numerical_error.hpp"
#include "plate/solve/matrices/attached_matrix.hpp"

namespace plate {
namespace {

constexpr double sweep = 0.6;  // weight of a Jacobi sweep
constexpr double reach = 1.5;  // horizon of the local plate, in spacings

/// A section whose bond-based plate (Poisson's ratio 1/3, no dilatation) comes nearest to the one given: D (1 + nu) and
/// D (1 - nu) met in the geometric mean, the same shear stiffness.
Section bond_based(const Section& s) {
  Section result = s;
  result.poisson = 1.0 / 3;
  const double D =
      s.bending_stiffness() * std::sqrt((1 - s.poisson * s.poisson) / (1 - result.poisson * result.poisson));
  result.young = 12 * D * (1 - result.poisson * result.poisson) / std::pow(s.thickness, 3);
  result.shear_correction *= s.shear_stiffness() / result.shear_stiffness();
  return result;
}

}  // namespace

FamilyOperator local_operator(const FamilyOperator& plate, const Boundary& boundary, const Section& section,
                              const Discretization& discretization) {
  auto families = geometry::without(plate.families(), [&](std::uint32_t k, std::uint32_t j) {
    return (boundary.lattice[k] - boundary.lattice[j]).norm() > reach;
  });
  Discretization full_cells = discretization;
  full_cells.volume_correction = VolumeCorrection::none;
  auto shapes = bond_shapes(families.vectors(), section, full_cells);
  const auto& areas = boundary.cloud.areas;
  const auto kinds = family_kinds(families, areas, boundary.active);
  auto weights = position_aware(families, shapes, areas, boundary.active, kinds, bond_based(section)).weights;
  FamilyOperator result(std::move(families), std::move(shapes), areas, std::move(weights));
  result.attach(plate.attached());
  return result;
}

LocalPlate::LocalPlate(const FamilyOperator& plate, const Boundary& boundary, const Section& section,
                       const Discretization& discretization, const Forces& added)
    : plate_(plate, plate.attached(), everywhere(plate.attached())), constraints_(boundary.constraints) {
  const Forces diagonal = folded_diagonal(plate, constraints_);
  inverse_diagonal_ = diagonal.unaryExpr([](double d) { return d > 0 ? sweep / d : 0.0; });
  const FamilyOperator local = local_operator(plate, boundary, section, discretization);
  const Forces both = folded_diagonal(local, constraints_).cwiseMin(diagonal);
  PointMatrix stiffness = stiffness_matrix(local, false);
  if (added.size() > 0) stiffness = plus(std::move(stiffness), added);
  const PointMatrix matrix = folded(std::move(stiffness), constraints_);
  unknowns_ = unknowns(both, elimination_order(matrix, both));
  factor_ = factorised(of_unknowns(matrix, unknowns_));
}

void LocalPlate::apply(const Forces& residual, State& result) const {
  const auto subtract_product = [&](State& direction) {  // rest = residual - K direction
    constraints_.impose(direction);
    plate_.internal_force(direction, product_);
    constraints_.fold(product_);
    rest_ = residual + product_;
  };
  result = inverse_diagonal_.cwiseProduct(residual);
  subtract_product(result);
  const Eigen::MatrixXd local = factor_->solve(gathered(unknowns_, rest_));
  for (Eigen::Index u = 0; u < local.rows(); ++u) at_dof(result, unknowns_.dof[std::size_t(u)]) += local(u, 0);
  subtract_product(result);
  result += inverse_diagonal_.cwiseProduct(rest_);
}

}  // namespace plate
