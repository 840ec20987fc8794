#include "post/interaction_integral.hpp"

#include <Eigen/Dense>
#include <unordered_map>

namespace post {
namespace {

using geometry::Point;

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

class DomainIntegral : public EnergyRelease {
public:
  DomainIntegral(const BondedPlate& plate, const TipFrame& frame, const Ring& ring) : ring_(plate, frame, ring) {}

  double operator()(const NearField& u) const override {
    double sum = 0;
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      const auto strains = ring_.strains(i, u);
      sum += ring_.release(i, strains, strains);
    }
    return sum;
  }

private:
  DomainRing ring_;
};

/// w, theta_x, theta_y of w and a rotation psi given in the tip's axes: psi = (-theta_y, theta_x).
Eigen::Vector3d to_state(const TipFrame& frame, const Eigen::Vector3d& local) {
  const Point psi = local[1] * frame.ahead + local[2] * frame.left();
  return {local[0], psi.y(), -psi.x()};
}

/// A unit field at the points of the plate; every value is computed once.
class UnitField {
public:
  UnitField(const BondedPlate& plate, const TipFrame& frame, const TipField& field)
      : plate_(plate), frame_(frame), field_(field) {}

  plate::Kinematics<> operator()(std::uint32_t k) const {
    const auto [entry, is_new] = known_.try_emplace(k);
    if (is_new) {
      const Eigen::Vector3d u = to_state(frame_, field_(polar(frame_, plate_.positions[k], plate_.spacing)));
      entry->second = {u[0], u[1], u[2]};
    }
    return entry->second;
  }

private:
  const BondedPlate& plate_;
  TipFrame frame_;
  const TipField& field_;
  mutable std::unordered_map<std::uint32_t, plate::Kinematics<>> known_;
};

}  // namespace

DomainRing::DomainRing(const BondedPlate& plate, const TipFrame& frame, const Ring& ring)
    : plate_(plate), ahead_(frame.ahead) {
  const double S = plate.section.shear_stiffness();
  const auto extension = [&](std::uint32_t k) { return ring.extension((plate.positions[k] - frame.origin).norm()); };
  for (std::uint32_t k = 0; k < plate.plate_points; ++k) {
    const Point x = plate.positions[k] - frame.origin;
    if (plate.galerkin) {  // the gradient of its families, for which Gauss's theorem holds
      if (x.norm() > 2 * ring.outer) continue;
      Point slope(0, 0);
      const auto family = plate.families[k];
      for (std::size_t i = 0; i < family.size(); ++i)
        slope += plate.galerkin->of(k)[i].gradient * (extension(family[i].neighbour) - extension(k));
      const plate::GalerkinStiffness stiffness(plate.section, plate.galerkin->square(k));
      if (slope.norm() > 0) points_.push_back({k, plate.areas[k] * slope, stiffness.shear, gradient_shares(plate, k)});
    } else if (const double slope = ring.slope(x.norm()); slope != 0) {
      points_.push_back({k, plate.areas[k] * slope * x / x.norm(), S, gradient_shares(plate, k)});
    }
  }
}

double DomainRing::release(std::size_t i, const PointStrains& a, const PointStrains& b) const {
  const double D = plate_.section.bending_stiffness(), nu = plate_.section.poisson, S = points_[i].shear_stiffness;
  const auto moments = [&](const Eigen::Matrix2d& psi) -> Eigen::Matrix2d {
    const Eigen::Matrix2d kappa = (psi + psi.transpose()) / 2;
    return D * ((1 - nu) * kappa + nu * kappa.trace() * Eigen::Matrix2d::Identity());
  };
  const auto flux = [&](const PointStrains& stressed, const PointStrains& carried) -> Point {
    return moments(stressed.psi) * (carried.psi * ahead_) + S * stressed.gamma * carried.w_slope;
  };
  const double energy = (moments(a.psi).cwiseProduct(b.psi).sum() + S * a.gamma.dot(b.gamma)) / 2;
  return points_[i].slope.dot((flux(a, b) + flux(b, a)) / 2 - energy * ahead_);
}

std::unique_ptr<EnergyRelease> domain_integral(const BondedPlate& plate, const TipFrame& frame, const Ring& ring) {
  return std::make_unique<DomainIntegral>(plate, frame, ring);
}

InteractionIntegral::InteractionIntegral(const BondedPlate& plate, const geometry::Tip& tip, const Ring& ring)
    : plate_(plate),
      ring_(plate, TipFrame(tip), ring),
      unit_strains_(ring_.size()),
      surroundings_(plate, tip, ring.outer),
      extensions_(surroundings_.extensions(ring)),
      unit_slopes_(surroundings_.points().size(), Eigen::Matrix3d::Zero()) {
  const TipFrame frame(tip);
  for (int mode = 0; mode < 3; ++mode) {
    const TipField field(plate.section, mode);
    const UnitField unit(plate, frame, field);
    for (std::size_t i = 0; i < ring_.size(); ++i) unit_strains_[i][std::size_t(mode)] = ring_.strains(i, unit);
    for (std::size_t i = 0; i < unit_slopes_.size(); ++i) {
      const auto& x = plate.positions[surroundings_.points()[i]];
      if ((x - frame.origin).norm() > 1e-6 * plate.spacing)
        unit_slopes_[i].col(mode) = to_state(frame, field.along_crack(polar(frame, x, plate.spacing)));
    }
  }
}

Eigen::Vector3d InteractionIntegral::operator()(const plate::State& state, const plate::Forces& force) const {
  const NearField field(state, plate_.positions, surroundings_.centre());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    const auto strains = ring_.strains(i, field);
    for (std::size_t mode = 0; mode < 3; ++mode)
      sum[Eigen::Index(mode)] += ring_.release(i, strains, unit_strains_[i][mode]);
  }
  for (std::size_t i = 0; i < unit_slopes_.size(); ++i)
    sum += extensions_[Eigen::Index(i)] / 2 * unit_slopes_[i].transpose() * force.col(surroundings_.points()[i]);
  return sum.cwiseQuotient(unit_release(plate_.section));
}

}  // namespace post
