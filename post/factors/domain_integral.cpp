#include "post/factors/tip_integrals.hpp"

namespace post {
namespace {

using geometry::Point;

/// What the domain integral takes from a field at a point: gradients of psi, shear angles and dw/dx' [1/length, 1, 1].
struct PointStrains {
  Eigen::Matrix2d psi = Eigen::Matrix2d::Zero();  // row: psi_x, psi_y; column: d/dx, d/dy
  geometry::Point gamma{0, 0};
  double w_slope = 0;
};

/// The points of a ring and the classical integral over them (theory (48)).
class DomainIntegral : public EnergyRelease {
public:
  DomainIntegral(const TipView& plate, const TipFrame& frame, const Ring& ring)
      : shapes_(plate.shapes), section_(plate.section.at(frame.origin)), ahead_(frame.ahead) {
    for (std::uint32_t k = 0; k < plate.plate_points; ++k) {
      const Point x = plate.positions[k] - frame.origin;
      if (x.norm() > 2 * ring.outer) continue;
      const Point slope = plate.extension_slope(k, frame, ring);
      if (slope != Point(0, 0))
        points_.push_back({k, plate.areas[k] * slope, plate.shear_stiffness(k), plate.gradient_shares(k)});
    }
  }

  double operator()(const NearField& u) const override {
    double sum = 0;
    for (const auto& point : points_) sum += release(point, strains(point, u));
    return sum;
  }

private:
  struct RingPoint {
    std::uint32_t k;
    Point slope;                      // area times grad q
    Eigen::Matrix2d shear_stiffness;  // [force / length]
    plate::GradientShares shares;
  };

  PointStrains strains(const RingPoint& point, const NearField& field) const {
    PointStrains result;
    const auto own = field(point.k);
    for (std::size_t n = 0; n < point.shares.bonds.size(); ++n) {
      const auto& bond = point.shares.bonds[n];
      const auto other = field(bond.neighbour);
      const Point share = point.shares.share.col(Eigen::Index(n));
      result.psi += Point(own.theta_y - other.theta_y, other.theta_x - own.theta_x) * share.transpose();
      result.gamma += share * shear_difference(shapes_[bond.vector_id], own, other);
    }
    result.w_slope = (result.gamma + Point(-own.theta_y, own.theta_x)).dot(ahead_);
    return result;
  }

  /// A (M_ab psi_a,x' + Q_b w,x' - W delta_bx') q,b.
  double release(const RingPoint& point, const PointStrains& u) const {
    const Eigen::Vector3d M = section_.bending * Eigen::Vector3d(u.psi(0, 0), u.psi(1, 1), u.psi(0, 1) + u.psi(1, 0));
    Eigen::Matrix2d moments;
    moments << M[0], M[2], M[2], M[1];
    const Point shear = point.shear_stiffness * u.gamma;
    const double energy = (moments.cwiseProduct(u.psi).sum() + shear.dot(u.gamma)) / 2;
    return point.slope.dot(moments * (u.psi * ahead_) + shear * u.w_slope - energy * ahead_);
  }

  const std::vector<plate::BondShape>& shapes_;
  plate::LocalSection section_;  // the same all over the ring
  Point ahead_;
  std::vector<RingPoint> points_;
};

}  // namespace

std::unique_ptr<EnergyRelease> domain_integral(const TipView& plate, const TipFrame& frame, const Ring& ring) {
  return std::make_unique<DomainIntegral>(plate, frame, ring);
}

}  // namespace post
