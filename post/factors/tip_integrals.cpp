#include "post/factors/tip_integrals.hpp"
#include "post/factors/near_field/tip_section.hpp"

#include <algorithm>
#include <cmath>

namespace post {

using geometry::Point;

Eigen::Vector3d unit_release(const plate::Section& section) {
  return TipSection(section).unit_release();
}

/// The strain energy has W = D (1 + nu) kappa_0 (tr grad psi + kappa_0) of it; the field is carried along with the tip,
/// while kappa_0 stays where it is.
double release_of_heat(const TipView& plate, const TipFrame& frame, const Ring& ring, const plate::State& field,
                       const Eigen::VectorXd& curvature) {
  double sum = 0;
  for (std::uint32_t k = 0; k < plate.plate_points; ++k) {
    const double r = (plate.positions[k] - frame.origin).norm();
    if (r > 2 * ring.outer) continue;
    const Point slope = plate.extension_slope(k, frame, ring);
    if (ring.extension(r) == 0 && slope == Point(0, 0)) continue;
    const auto theta = plate.gradients(k, field).theta;
    Eigen::Matrix2d psi;  // psi = (-theta_y, theta_x)
    psi << -theta.row(1), theta.row(0);
    Point slope_of_curvature(0, 0);
    const auto shares = plate.gradient_shares(k);
    for (std::size_t i = 0; i < shares.bonds.size(); ++i)
      if (const auto j = shares.bonds[i].neighbour; j < plate.plate_points)
        slope_of_curvature += shares.share.col(Eigen::Index(i)) * (curvature[j] - curvature[k]);
    const double own = curvature[k], trace = psi.trace();
    const double carried = own * (psi * frame.ahead).dot(slope) - own * (trace + own) * slope.dot(frame.ahead);
    sum += plate.areas[k] * (carried - ring.extension(r) * (trace + 2 * own) * slope_of_curvature.dot(frame.ahead));
  }
  return plate.section.bending_stiffness() * (1 + plate.section.poisson) * sum;
}

TipSurroundings::TipSurroundings(const TipView& plate, const geometry::Tip& tip, double radius)
    : plate_(&plate), frame_(tip) {
  for (std::uint32_t k = 0; k < plate.plate_points; ++k) {
    const double r = (plate.positions[k] - frame_.origin).norm();
    if (r < radius) points_.push_back(k);
    if (r < 2 * plate.spacing) centre_.push_back(k);
  }
  const auto distance = [&](std::uint32_t k) { return (plate.positions[k] - frame_.origin).squaredNorm(); };
  std::stable_sort(points_.begin(), points_.end(), [&](auto a, auto b) { return distance(a) < distance(b); });
}

Eigen::VectorXd TipSurroundings::extensions(const Ring& ring) const {
  Eigen::VectorXd result(Eigen::Index(points_.size()));
  for (std::size_t i = 0; i < points_.size(); ++i)
    result[Eigen::Index(i)] = ring.extension((plate_->positions[points_[i]] - frame_.origin).norm());
  return result;
}

Eigen::VectorXd TipSurroundings::forward_work(const plate::State& state, const plate::Forces& force,
                                              double radius) const {
  const NearField field(state, plate_->positions, centre_);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(Eigen::Index(points_.size()));
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto k = points_[i];
    if ((plate_->positions[k] - frame_.origin).norm() > radius) break;
    const Eigen::Vector3d f = force.col(k);
    if (f.isZero(0)) continue;
    const auto gradients = plate_->gradients(k, state);
    const auto own = field(k);
    const double w_slope = frame_.ahead.dot(gradients.shear + Point(-own.theta_y, own.theta_x));  // gamma + psi
    result[Eigen::Index(i)] = f[0] * w_slope + f.tail<2>().dot(gradients.theta * frame_.ahead);
  }
  return result;
}

}  // namespace post
