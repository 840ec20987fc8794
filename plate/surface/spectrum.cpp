#include "plate/surface/spectrum.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace plate {

EdgeSpectrum spectrum(const SurfacePlate& p, const EdgeConditions& edges, double thickness) {
  constexpr double rounding = 1e-10;  // of the largest; rigid motions of a free plate: 1e-15 to 1e-13
  const auto held = edge_problem(p, edges, [](const geometry::Point&) { return Eigen::Vector3d(0, 0, 0); }).held;
  std::vector<char> is_held(std::size_t(p.unknowns()), false);
  for (const auto& one : held) is_held[std::size_t(one.unknown)] = true;
  std::vector<Eigen::Index> surface;
  for (Eigen::Index i = 3 * p.body.real; i < p.unknowns(); ++i)
    if (!is_held[std::size_t(i)]) surface.push_back(i);
  const Eigen::MatrixXd K = stiffness_under(p, edges);
  const Eigen::Index n = 3 * p.body.real;
  Eigen::MatrixXd inside = K.topLeftCorner(n, n);
  if (!surface.empty()) {
    const Eigen::MatrixXd follow =
        Eigen::MatrixXd(K(surface, surface)).partialPivLu().solve(K(surface, Eigen::seqN(0, n)));
    inside -= K(Eigen::seqN(0, n), surface) * follow;
  }
  const double rotary = std::sqrt(12.0) / thickness;  // mass per area: 1, h^2 / 12, h^2 / 12
  const Eigen::VectorXd scale = Eigen::Vector3d(1, rotary, rotary).replicate(p.body.real, 1);
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
