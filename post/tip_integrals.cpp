#include "post/tip_integrals.hpp"

#include <Eigen/Dense>
#include <numbers>

namespace post {
namespace {

using geometry::Point;

/// theta of a rotation psi given in the tip's axes: psi = (-theta_y, theta_x).
Eigen::Vector3d to_state(const TipFrame& frame, const Eigen::Vector3d& local) {
  const Point psi = local[1] * frame.ahead + local[2] * frame.left();
  return {local[0], psi.y(), -psi.x()};
}

/// The three unit fields at all points within `radius` of the tip.
std::array<plate::State, 3> auxiliary_states(const BondedPlate& plate, const TipFrame& frame,
                                             const std::array<TipField, 3>& fields, double radius) {
  std::array<plate::State, 3> states;
  for (std::size_t mode = 0; mode < 3; ++mode) {
    const TipField& field = fields[mode];
    auto& state = states[mode];
    state.setZero(3, Eigen::Index(plate.positions.size()));
    for (std::size_t k = 0; k < plate.positions.size(); ++k) {
      if ((plate.positions[k] - frame.origin).norm() > radius) continue;
      state.col(Eigen::Index(k)) = to_state(frame, field(polar(frame, plate.positions[k], plate.spacing)));
    }
  }
  return states;
}

}  // namespace

Eigen::Vector3d unit_release(const plate::Section& s) {
  const double bending = 12 * std::numbers::pi / (s.young * std::pow(s.thickness, 3));
  const double shear = std::numbers::pi * (1 + s.poisson) / (s.shear_correction * s.young * s.thickness);
  return {bending, bending, shear};
}

TipIntegral::TipIntegral(const BondedPlate& plate, const geometry::Tip& tip, const Ring& ring,
                         std::unique_ptr<EnergyRelease> release)
    : section_(plate.section), positions_(plate.positions), release_(std::move(release)) {
  const TipFrame frame(tip);
  const std::array<TipField, 3> fields{TipField(plate.section, 0), TipField(plate.section, 1), TipField(plate.section, 2)};
  auxiliary_ = auxiliary_states(plate, frame, fields, ring.outer + 5 * plate.spacing);
  for (std::uint32_t k = 0; k < plate.plate_points; ++k) {
    const Point x = plate.positions[k] - frame.origin;
    const double r = x.norm(), q = ring.extension(r);
    if (q == 0) continue;
    Inside inside{k, q, slope_at(plate, frame, k), {}};
    inside.auxiliary_slope.fill(Eigen::Vector3d::Zero());

    if (r > 1e-6 * plate.spacing)
      for (int mode = 0; mode < 3; ++mode) {
        const Polar at = polar(frame, plate.positions[k], plate.spacing);
        inside.auxiliary_slope[std::size_t(mode)] = to_state(frame, fields[std::size_t(mode)].along_crack(at));
      }
    inside_.push_back(std::move(inside));
    if (r < 2 * plate.spacing) centre_.push_back(k);
  }
}

TipIntegral::Slope TipIntegral::slope_at(const BondedPlate& plate, const TipFrame& frame, std::uint32_t k) const {
  Eigen::Matrix2d shape = Eigen::Matrix2d::Zero();
  const auto& families = plate.families;
  const auto weight = [&](std::size_t b) {
    return plate.shapes[families.vector_id[b]].weight * plate.areas[families.neighbour[b]];
  };
  for (auto b = families.first[k]; b < families.first[k + 1]; ++b) {
    const Point& xi = families.vectors[families.vector_id[b]];
    shape += weight(b) * xi * xi.transpose();
  }
  const Eigen::Matrix2d inverse = shape.completeOrthogonalDecomposition().pseudoInverse();
  Slope slope{frame.ahead, {}};
  for (auto b = families.first[k]; b < families.first[k + 1]; ++b) {
    const auto id = families.vector_id[b];
    slope.terms.push_back({families.neighbour[b], weight(b) * frame.ahead.dot(inverse * families.vectors[id]), plate.shapes[id]});
  }
  return slope;
}

/// d/dx' of w, theta_x, theta_y at a point: w,x' = gamma + psi.
Eigen::Vector3d TipIntegral::Slope::operator()(const plate::State& state, std::uint32_t k) const {
  const auto at = [&](std::uint32_t i) {
    const auto u = state.col(Eigen::Index(i));
    return plate::Kinematics<>{u[0], u[1], u[2]};
  };
  const auto own = at(k);
  Eigen::Vector3d sum(ahead.dot(Point(-own.theta_y, own.theta_x)), 0, 0);
  for (const auto& term : terms) {
    const auto other = at(term.neighbour);
    sum += term.share * Eigen::Vector3d(shear_difference(term.bond, own, other), other.theta_x - own.theta_x,
                                        other.theta_y - own.theta_y);
  }
  return sum;
}

/// The state less the rigid motion of the points next to the tip, which does no work but would cost digits.
plate::State TipIntegral::without_rigid_motion(const plate::State& state) const {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Point place(0, 0);
  for (const auto k : centre_) {
    mean += state.col(k) / double(centre_.size());
    place += positions_[k] / double(centre_.size());
  }
  plate::State result = state;
  for (Eigen::Index k = 0; k < result.cols(); ++k) {
    const Point x = positions_[std::size_t(k)] - place;
    result.col(k) -= Eigen::Vector3d(mean[0] - mean[2] * x.x() + mean[1] * x.y(), mean[1], mean[2]);
  }
  return result;
}

TipRates TipIntegral::operator()(const plate::State& whole, const plate::Forces& force) const {
  const plate::State state = without_rigid_motion(whole);
  TipRates result;
  result.G = (*release_)(state, state);
  for (std::size_t mode = 0; mode < 3; ++mode) result.K[Eigen::Index(mode)] = (*release_)(state, auxiliary_[mode]);
  for (const auto& inside : inside_) {
    const auto k = Eigen::Index(inside.point);
    const Eigen::Vector3d f = force.col(k) * inside.extension;
    result.G += f.dot(inside.slope(state, inside.point));
    for (std::size_t mode = 0; mode < 3; ++mode)
      result.K[Eigen::Index(mode)] += f.dot(inside.auxiliary_slope[mode]) / 2;
  }
  result.K = result.K.cwiseQuotient(unit_release(section_));
  return result;
}

}  // namespace post
