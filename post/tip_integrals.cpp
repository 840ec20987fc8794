#include "post/tip_integrals.hpp"

#include <cmath>
#include <numbers>

#include "plate/resultants.hpp"

namespace post {

using geometry::Point;

Eigen::Vector3d unit_release(const plate::Section& s) {
  const double bending = 12 * std::numbers::pi / (s.young * std::pow(s.thickness, 3));
  const double shear = std::numbers::pi * (1 + s.poisson) / (s.shear_correction * s.young * s.thickness);
  return {bending, bending, shear};
}

double Ring::extension(double r) const {
  if (r <= inner) return 1;
  if (r >= outer) return 0;
  return (1 + std::cos(std::numbers::pi * (r - inner) / (outer - inner))) / 2;
}

double Ring::slope(double r) const {
  if (r <= inner || r >= outer) return 0;
  const double width = outer - inner;
  return -std::numbers::pi / (2 * width) * std::sin(std::numbers::pi * (r - inner) / width);
}

std::vector<MovedPoint> moved_points(const BondedPlate& plate, const TipFrame& frame, const Ring& ring) {
  std::vector<MovedPoint> result;
  for (std::uint32_t k = 0; k < plate.plate_points; ++k)
    if (const double q = ring.extension((plate.positions[k] - frame.origin).norm()); q != 0) result.push_back({k, q});
  return result;
}

std::vector<std::uint32_t> next_to_tip(const BondedPlate& plate, const TipFrame& frame) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t k = 0; k < plate.plate_points; ++k)
    if ((plate.positions[k] - frame.origin).norm() < 2 * plate.spacing) result.push_back(k);
  return result;
}

NearField::NearField(const plate::State& state, const std::vector<Point>& positions, const std::vector<std::uint32_t>& centre)
    : state_(state), positions_(positions) {
  for (const auto k : centre) {
    mean_ += state.col(k) / double(centre.size());
    place_ += positions[k] / double(centre.size());
  }
}

plate::Kinematics<> NearField::operator()(std::uint32_t k) const {
  const Point x = positions_[k] - place_;
  const auto u = state_.col(k);
  return {u[0] - mean_[0] + mean_[2] * x.x() - mean_[1] * x.y(), u[1] - mean_[1], u[2] - mean_[2]};
}

TipIntegral::TipIntegral(const BondedPlate& plate, const geometry::Tip& tip, const Ring& ring,
                         std::unique_ptr<EnergyRelease> release)
    : plate_(plate), ahead_(tip.direction), release_(std::move(release)), moved_(moved_points(plate, TipFrame(tip), ring)),
      centre_(next_to_tip(plate, TipFrame(tip))) {}

double TipIntegral::operator()(const plate::State& state, const plate::Forces& force) const {
  const NearField field(state, plate_.positions, centre_);
  double G = (*release_)(field);
  for (const auto& moved : moved_) {
    const auto f = force.col(moved.point);
    if (f.isZero(0)) continue;
    const auto gradients = plate::gradients(moved.point, state, plate_.families, plate_.shapes, plate_.areas);
    const auto own = field(moved.point);
    const double w_slope = ahead_.dot(gradients.shear + Point(-own.theta_y, own.theta_x));  // gamma + psi
    G += moved.extension * (f[0] * w_slope + f.tail<2>().dot(gradients.theta * ahead_));
  }
  return G;
}

}  // namespace post
