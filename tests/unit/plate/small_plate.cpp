#include "tests/unit/plate/small_plate.hpp"

#include <random>

#include "geometry/lattice/cloud.hpp"
#include "plate/bonds/family_weights.hpp"
#include "plate/bonds/horizon_parameters.hpp"
#include "plate/bonds/supports.hpp"

namespace small_plate {

plate::HorizonWeights horizon_weights(const geometry::Families& families, const std::vector<plate::BondShape>& shapes,
                                      const plate::Boundary& boundary, const plate::Discretization& d,
                                      plate::PlateLaw law) {
  plate::Section own = section;
  own.law = law;
  const auto& areas = boundary.cloud.areas;
  const auto kinds = plate::family_kinds(families, areas, boundary.active);
  if (d.surface_correction == plate::SurfaceCorrection::position_aware)
    return plate::position_aware(families, shapes, areas, boundary.active, kinds, own).weights;
  return plate::weights_of_parameters(families, shapes, areas, kinds,
                                      plate::horizon_parameters(families, shapes, areas, boundary.active, own, d));
}

Model model(const geometry::Outline& outline, const std::vector<plate::Support>& supports,
            const plate::Discretization& d, const std::vector<geometry::CrackPath>& cracks, plate::PlateLaw law) {
  auto cloud = geometry::lattice(outline, d.spacing);
  const auto cells = geometry::to_lattice(outline, cloud.units);
  auto boundary = plate::boundary(std::move(cloud), cells, supports, d, {}, {}, law);
  auto families = geometry::families(boundary.cloud, d.horizon(), plate::sees(boundary, cells, d.horizon_ratio));
  if (!cracks.empty())
    families = geometry::without(families, [&](std::uint32_t k, std::uint32_t j) {
      for (const auto& crack : cracks)
        if (geometry::separates(crack, boundary.lattice[k], boundary.lattice[j])) return true;
      return false;
    });
  auto shapes = plate::bond_shapes(families.vectors(), section, d);
  const auto& areas = boundary.cloud.areas;
  auto weights = horizon_weights(families, shapes, boundary, d, law);
  plate::FamilyOperator op(std::move(families), std::move(shapes), areas, std::move(weights));
  return {outline, cells, d, std::move(boundary), std::move(op)};
}

plate::Discretization spaced(double spacing) {
  plate::Discretization d;
  d.spacing = spacing;
  return d;
}

plate::State random_state(Eigen::Index points, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return plate::State::NullaryExpr(3, points, [&] { return uniform(random); });
}

Eigen::MatrixXd stiffness(const plate::FamilyOperator& op) {
  const auto points = static_cast<Eigen::Index>(op.points());
  Eigen::MatrixXd K(3 * points, 3 * points);
  plate::State unit = plate::State::Zero(3, points);
  plate::Forces forces;
  for (Eigen::Index n = 0; n < K.cols(); ++n) {
    plate::at_dof(unit, plate::dof_by_points(n)) = 1;
    op.internal_force(unit, forces);
    plate::at_dof(unit, plate::dof_by_points(n)) = 0;
    K.col(n) = -forces.reshaped();
  }
  return K;
}

Eigen::MatrixXd prolongation(const plate::Constraints& constraints, Eigen::Index dofs) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Identity(dofs, dofs);
  const auto number = [](const plate::Dof& dof) {
    return plate::index_by_points(Eigen::Index(dof.point), dof.component);
  };
  for (const auto dof : constraints.fixed()) all(number(dof), number(dof)) = 0;
  for (const auto& tie : constraints.ties())
    all(number(tie.follower), number(tie.follower)) = 0, all(number(tie.follower), number(tie.leader)) = tie.factor;
  std::vector<Eigen::Index> free;
  for (Eigen::Index n = 0; n < dofs; ++n)
    if (all(n, n) == 1) free.push_back(n);
  return all(Eigen::all, free);
}

}  // namespace small_plate
