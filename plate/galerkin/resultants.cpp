#include "plate/galerkin/resultants.hpp"

namespace plate {

Resultants resultants(const State& state, const GalerkinFamilies& families, const PointSections& sections) {
  const auto count = static_cast<Eigen::Index>(families.areas.size());
  Resultants result = resultants_of(count);
#pragma omp parallel for schedule(static)
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto strains = family_strains(families, std::size_t(k), state);
    const GalerkinStiffness stiffness(sections[std::size_t(k)], families.square(std::size_t(k)));
    Eigen::Matrix2d theta;  // psi = (-theta_y, theta_x)
    theta << strains.psi.row(1), -strains.psi.row(0);
    set(result, k, sections[std::size_t(k)], theta, stiffness.shear * strains.gamma);
  }
  return result;
}

}  // namespace plate
