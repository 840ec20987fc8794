#pragma once
#include <array>
#include <optional>
#include "post/tip_integrals.hpp"

namespace post {

/// What the domain integral takes from a field at a point: gradients of psi, shear angles and dw/dx' [1/length, 1, 1].
struct PointStrains {
  Eigen::Matrix2d psi = Eigen::Matrix2d::Zero();  // row: psi_x, psi_y; column: d/dx, d/dy
  geometry::Point gamma{0, 0};
  double w_slope = 0;
};

/// Gradients at a point, by least squares over neighbours.
struct GradientShares {
  std::vector<geometry::Bond> bonds;
  Eigen::Matrix2Xd share;  // per bond: of a difference along the bond, in the gradient
};

/// The points of a ring and the bilinear form of the domain integral over them (theory.md, Eq. 35b).
class DomainRing {
public:
  DomainRing(const BondedPlate& plate, const TipFrame& frame, const Ring& ring);

  std::size_t size() const { return points_.size(); }
  std::uint32_t point(std::size_t i) const { return points_[i].k; }
  /// The symmetric part of -dU/da of two fields at the i-th point [force].
  double release(std::size_t i, const PointStrains& a, const PointStrains& b) const;

  /// `field(k)`: plate::Kinematics of a point.
  template <typename Field>
  PointStrains strains(std::size_t i, const Field& field) const {
    const auto& point = points_[i];
    PointStrains result;
    const auto own = field(point.k);
    for (std::size_t n = 0; n < point.shares.bonds.size(); ++n) {
      const auto& bond = point.shares.bonds[n];
      const auto other = field(bond.neighbour);
      const geometry::Point share = point.shares.share.col(Eigen::Index(n));
      result.psi += geometry::Point(own.theta_y - other.theta_y, other.theta_x - own.theta_x) * share.transpose();
      result.gamma += share * shear_difference(plate_.shapes[bond.vector_id], own, other);
    }
    result.w_slope = (result.gamma + geometry::Point(-own.theta_y, own.theta_x)).dot(ahead_);
    return result;
  }

private:
  struct RingPoint {
    std::uint32_t k;
    geometry::Point slope;  // area times grad q
    double shear_stiffness; // [force / length]
    GradientShares shares;
  };

  BondedPlate plate_;
  geometry::Point ahead_;
  std::vector<RingPoint> points_;
};

/// K1, K2, K3 by the interaction of a field with the three unit fields of a tip (theory.md, Eq. 35c).
class InteractionIntegral {
public:
  InteractionIntegral(const BondedPlate& plate, const geometry::Tip& tip, const Ring& ring);

  /// `force`: as in TipSurroundings.
  Eigen::Vector3d operator()(const plate::State& state, const plate::Forces& force) const;

private:
  using Unit = std::array<PointStrains, 3>;

  BondedPlate plate_;
  DomainRing ring_;
  std::vector<Unit> unit_strains_;  // per point of the ring
  TipSurroundings surroundings_;
  Eigen::VectorXd extensions_;
  std::vector<Eigen::Matrix3d> unit_slopes_;  // per point around; column: d/dx' of w, theta_x, theta_y of a unit field
};

}  // namespace post
