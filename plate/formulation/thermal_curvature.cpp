#include "plate/formulation/thermal_curvature.hpp"

#include <algorithm>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/sections.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/section.hpp"

namespace plate {

Heat heat_of(const Formulation& plate, const std::vector<double>& shares) {
  Heat result;
  for (std::size_t i = 0; i < plate.loads().size(); ++i) {
    const auto& load = plate.loads()[i];
    if (load.curvature.size() == 0 || shares[i] == 0) continue;
    if (result.none()) {
      result.curvature = Eigen::VectorXd::Zero(load.curvature.size());
      result.forces = zero_forces(load.forces.cols());
    }
    result.curvature += shares[i] * load.curvature, result.forces += shares[i] * load.forces;
  }
  return result;
}

Heat heat_at(const Formulation& plate, double time) {
  std::vector<double> shares;
  for (const auto& load : plate.loads()) shares.push_back(factor(load.history, time));
  return heat_of(plate, shares);
}

Heat heat_of(const Formulation& plate, double share) {
  return heat_of(plate, std::vector<double>(plate.loads().size(), share));
}

Eigen::Vector3d moments_held_flat(const Section& section) {
  if (section.isotropic()) {
    const double each = section.bending_stiffness() * (1 + section.poisson);
    return {each, each, 0};
  }
  return LocalSection(section).bending * Eigen::Vector3d(1, 1, 0);
}

double stored(const Formulation& plate, const Heat& heat, const State& state) {
  if (!heated(plate.problem())) return 0;
  const double each = moments_held_flat(plate.section()).head<2>().sum() / 2;
  const auto held_flat = [&](Eigen::Index k) {
    return plate.cloud().areas[std::size_t(k)] * heat.curvature[k] * heat.curvature[k];
  };
  return ordered_sum<1>(plate, std::size_t(state.cols()), [&](std::size_t n) {
    const auto k = Eigen::Index(n);
    if (heat.none() || !plate.boundary().owns(n)) return std::array<double, 1>{0};
    return std::array<double, 1>{(k < heat.curvature.size() ? each * held_flat(k) : 0) -
                                 heat.forces.col(k).dot(state.col(k))};
  })[0];
}

void relieve(Resultants& resultants, const Section& section, const Heat& heat) {
  if (heat.none() || resultants.moments.cols() == 0) return;
  const Eigen::Vector3d each = moments_held_flat(section);
  for (Eigen::Index k = 0; k < heat.curvature.size(); ++k) {
    resultants.moments.col(k) -= heat.curvature[k] * each;
    resultants.von_mises[k] = von_mises(resultants.moments.col(k), section);
  }
}

State cold(const State& state, const std::vector<geometry::Point>& positions, const geometry::Point& place,
           double curvature) {
  State result = state;
  for (Eigen::Index k = 0; k < result.cols(); ++k) {
    const geometry::Point x = positions[std::size_t(k)] - place;
    result.col(k) += curvature * PointValues(x.squaredNorm() / 2, x.y(), -x.x());
  }
  return result;
}

}  // namespace plate
