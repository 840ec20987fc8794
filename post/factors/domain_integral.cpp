
#include <Eigen/Dense>
#include <optional>

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

/// Gradients at a point, by least squares over neighbours.
struct GradientShares {
  std::vector<geometry::Bond> bonds;
  Eigen::Matrix2Xd share;  // per bond: of a difference along the bond, in the gradient
};

/// By the bonds no longer than `reach` spacings; nothing where they do not determine linear and quadratic terms.
std::optional<GradientShares> quadratic_shares(const BondedPlate& plate, std::uint32_t k, double reach) {
  const auto& families = plate.families;
  GradientShares result;
  for (const auto& bond : families[k])
    if (plate.shapes[bond.vector_id].length < reach * plate.spacing)
      result.bonds.push_back(bond);
  const auto count = static_cast<Eigen::Index>(result.bonds.size());
  if (count < 5) return std::nullopt;
  Eigen::MatrixXd basis(count, 5);
  Eigen::VectorXd weight(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Point x = families.vectors()[result.bonds[std::size_t(i)].vector_id] / plate.spacing;
    basis.row(i) << x.x(), x.y(), x.x() * x.x(), x.x() * x.y(), x.y() * x.y();
    weight[i] = 1 / x.squaredNorm();
  }
  const auto solver = (weight.asDiagonal() * basis).completeOrthogonalDecomposition();
  if (solver.rank() < 5) return std::nullopt;
  result.share = solver.pseudoInverse().topRows(2) * weight.asDiagonal() / plate.spacing;
  return result;
}

/// From the nearest neighbours that suffice: the layer beside a face is as thin as a few spacings.
GradientShares gradient_shares(const BondedPlate& plate, std::uint32_t k) {
  if (plate.galerkin) {
    const auto family = plate.families[k];
    GradientShares own{{}, Eigen::Matrix2Xd(2, Eigen::Index(family.size()))};
    for (std::size_t i = 0; i < family.size(); ++i) {
      own.bonds.push_back(family[i]);
      own.share.col(Eigen::Index(i)) = plate.galerkin->of(k)[i].gradient;
    }
    return own;
  }
  for (const double reach : {1.5, 2.1, 3.0, 100.0})
    if (auto found = quadratic_shares(plate, k, reach)) return *found;
  GradientShares linear;
  const auto& families = plate.families;
  Eigen::MatrixXd basis(Eigen::Index(families[k].size()), 2);
  for (const auto& bond : families[k]) {
    basis.row(Eigen::Index(linear.bonds.size())) = families.vectors()[bond.vector_id].transpose();
    linear.bonds.push_back(bond);
  }
  linear.share = basis.completeOrthogonalDecomposition().pseudoInverse();
  return linear;
}

/// The points of a ring and the classical integral over them (theory.md, Eq. 35b).
class DomainIntegral : public EnergyRelease {
public:
  DomainIntegral(const BondedPlate& plate, const TipFrame& frame, const Ring& ring)
      : shapes_(plate.shapes), section_(plate.section), ahead_(frame.ahead) {
    for (std::uint32_t k = 0; k < plate.plate_points; ++k) {
      const Point x = plate.positions[k] - frame.origin;
      if (x.norm() > 2 * ring.outer) continue;
      const Point slope = slope_at(plate, frame, ring, k);
      const double S = plate.galerkin ? plate::GalerkinStiffness(plate.section, plate.galerkin->square(k)).shear
                                      : plate.section.shear_stiffness();
      if (slope != Point(0, 0)) points_.push_back({k, plate.areas[k] * slope, S, gradient_shares(plate, k)});
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
    Point slope;             // area times grad q
    double shear_stiffness;  // [force / length]
    GradientShares shares;
  };

  /// grad q: in the Galerkin plate by its families, for which Gauss's theorem holds.
  static Point slope_at(const BondedPlate& plate, const TipFrame& frame, const Ring& ring, std::uint32_t k) {
    const Point x = plate.positions[k] - frame.origin;
    if (!plate.galerkin) return x.norm() > 0 ? Point(ring.slope(x.norm()) / x.norm() * x) : Point(0, 0);
    const auto extension = [&](std::uint32_t j) { return ring.extension((plate.positions[j] - frame.origin).norm()); };
    Point slope(0, 0);
    const auto family = plate.families[k];
    for (std::size_t i = 0; i < family.size(); ++i)
      slope += plate.galerkin->of(k)[i].gradient * (extension(family[i].neighbour) - extension(k));
    return slope;
  }

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
    const double D = section_.bending_stiffness(), nu = section_.poisson;
    const Eigen::Matrix2d kappa = (u.psi + u.psi.transpose()) / 2;
    const Eigen::Matrix2d moments = D * ((1 - nu) * kappa + nu * kappa.trace() * Eigen::Matrix2d::Identity());
    const Point shear = point.shear_stiffness * u.gamma;
    const double energy = (moments.cwiseProduct(u.psi).sum() + shear.dot(u.gamma)) / 2;
    return point.slope.dot(moments * (u.psi * ahead_) + shear * u.w_slope - energy * ahead_);
  }

  const std::vector<plate::BondShape>& shapes_;
  plate::Section section_;
  Point ahead_;
  std::vector<RingPoint> points_;
};

}  // namespace

std::unique_ptr<EnergyRelease> domain_integral(const BondedPlate& plate, const TipFrame& frame, const Ring& ring) {
  return std::make_unique<DomainIntegral>(plate, frame, ring);
}

}  // namespace post
