#include "post/factors/tip_integrals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plate/model/resultants.hpp"

namespace post {

using geometry::Point;

namespace {

plate::Gradients gradients_at(const BondedPlate& plate, std::uint32_t k, const plate::State& state) {
  if (!plate.galerkin) return plate::gradients(k, state, plate.families, plate.shapes, plate.areas);
  const auto strains = plate::family_strains(*plate.galerkin, k, state);
  plate::Gradients result{Eigen::Matrix2d(), strains.gamma};
  result.theta << strains.psi.row(1), -strains.psi.row(0);  // psi = (-theta_y, theta_x)
  return result;
}

}  // namespace

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

NearField::NearField(const plate::State& state, const std::vector<Point>& positions,
                     const std::vector<std::uint32_t>& centre)
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

TipSurroundings::TipSurroundings(const BondedPlate& plate, const geometry::Tip& tip, double radius)
    : plate_(plate), frame_(tip) {
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
    result[Eigen::Index(i)] = ring.extension((plate_.positions[points_[i]] - frame_.origin).norm());
  return result;
}

Eigen::VectorXd TipSurroundings::forward_work(const plate::State& state, const plate::Forces& force,
                                              double radius) const {
  const NearField field(state, plate_.positions, centre_);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(Eigen::Index(points_.size()));
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto k = points_[i];
    if ((plate_.positions[k] - frame_.origin).norm() > radius) break;
    const Eigen::Vector3d f = force.col(k);
    if (f.isZero(0)) continue;
    const auto gradients = gradients_at(plate_, k, state);
    const auto own = field(k);
    const double w_slope = frame_.ahead.dot(gradients.shear + Point(-own.theta_y, own.theta_x));  // gamma + psi
    result[Eigen::Index(i)] = f[0] * w_slope + f.tail<2>().dot(gradients.theta * frame_.ahead);
  }
  return result;
}

}  // namespace post
