#include "plate/position_aware.hpp"
#include "post/tip_integrals.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <optional>

namespace post {
namespace {

using geometry::Point;
using plate::Kinematics;
using plate::State;

Kinematics<> at(const State& state, std::uint32_t k) {
  const auto u = state.col(static_cast<Eigen::Index>(k));
  return {u[0], u[1], u[2]};
}

/// Plate points that the extension moves, or whose neighbours it moves otherwise than themselves.
std::vector<std::uint32_t> points_of(const BondedPlate& plate, const TipFrame& frame, const Ring& ring, double reach) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t k = 0; k < plate.plate_points; ++k) {
    const double r = (plate.positions[k] - frame.origin).norm();
    if (r > ring.inner - reach && r < ring.outer + reach) found.push_back(k);
  }
  return found;
}

/// The plate's energy in the bonds of the ring, at two positions of the tip one step before and after.
class MovedBonds : public EnergyRelease {
public:
  MovedBonds(const BondedPlate& plate, const TipFrame& frame, const Ring& ring) {
    const double step = 1e-4 * plate.spacing;
    const auto extension = [&](std::uint32_t k) { return ring.extension((plate.positions[k] - frame.origin).norm()); };
    for (const auto k : points_of(plate, frame, ring, 4 * plate.spacing)) {
      const Point x = plate.positions[k] - frame.origin;
      const double divergence = x.norm() > 0 ? ring.slope(x.norm()) * x.dot(frame.ahead) / x.norm() : 0;
      const double own = extension(k);
      bool moves = divergence != 0;
      for (auto b = plate.families.first[k]; b < plate.families.first[k + 1]; ++b)
        moves = moves || extension(plate.families.neighbour[b]) != own;
      if (!moves) continue;
      for (const int sign : {1, -1}) {
        std::vector<plate::FamilyBond> bonds;
        for (auto b = plate.families.first[k]; b < plate.families.first[k + 1]; ++b) {
          const auto j = plate.families.neighbour[b];
          const auto id = plate.families.vector_id[b];
          bonds.push_back({plate.families.vectors[id] + sign * step * (extension(j) - own) * frame.ahead,
                           plate.shapes[id].weight * plate.areas[j]});
        }
        const auto weights = plate::position_aware(plate.section, bonds);
        const double share = -sign * plate.areas[k] * (1 + sign * step * divergence) / (2 * step);
        RingPoint point{k, share, weights.a, bonds_.size(), 0};
        for (std::size_t i = 0; i < bonds.size(); ++i) {
          const double length = bonds[i].vector.norm();
          bonds_.push_back({plate.families.neighbour[plate.families.first[k] + i], bonds[i].vector.y() / length,
                            -bonds[i].vector.x() / length, length, weights.bonds[i]});
        }
        point.end = bonds_.size();
        points_.push_back(point);
      }
    }
  }

  double operator()(const State& u, const State& v) const override {
    double sum = 0;
    for (const auto& point : points_) {
      const auto u_k = at(u, point.k), v_k = at(v, point.k);
      double energy = 0, dilatation_u = 0, dilatation_v = 0;
      for (auto b = point.begin; b < point.end; ++b) {
        const Bond& bond = bonds_[b];
        const auto u_j = at(u, bond.j), v_j = at(v, bond.j);
        const double curvature_u = curvature_difference(bond, u_k, u_j), curvature_v = curvature_difference(bond, v_k, v_j);
        dilatation_u += bond.weights.D * curvature_u;
        dilatation_v += bond.weights.D * curvature_v;
        energy += bond.weights.B * curvature_u * curvature_v +
                  bond.weights.S * shear_difference(bond, u_k, u_j) * shear_difference(bond, v_k, v_j);
      }
      sum += point.share * (energy + point.a * dilatation_u * dilatation_v);
    }
    return sum;
  }

private:
  struct Bond {
    std::uint32_t j;
    double mx, my, length;
    plate::BondWeights weights;
  };
  struct RingPoint {
    std::uint32_t k;
    double share, a;  // share: of its energy in -dU/da
    std::size_t begin, end;
  };
  std::vector<RingPoint> points_;
  std::vector<Bond> bonds_;
};

/// Gradients at a point by least squares over its family: linear and quadratic terms where the family has both.
struct GradientShares {
  std::vector<std::uint32_t> bonds;
  Eigen::Matrix2Xd share;  // per bond: of a difference along the bond, in the gradient
};

/// By the bonds no longer than `reach` spacings; nothing where they do not determine linear and quadratic terms.
std::optional<GradientShares> quadratic_shares(const BondedPlate& plate, std::uint32_t k, double reach) {
  const auto& families = plate.families;
  GradientShares result;
  for (auto b = families.first[k]; b < families.first[k + 1]; ++b)
    if (plate.shapes[families.vector_id[b]].length < reach * plate.spacing) result.bonds.push_back(static_cast<std::uint32_t>(b));
  const auto count = static_cast<Eigen::Index>(result.bonds.size());
  if (count < 5) return std::nullopt;
  Eigen::MatrixXd basis(count, 5);
  Eigen::VectorXd weight(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Point x = families.vectors[families.vector_id[result.bonds[std::size_t(i)]]] / plate.spacing;
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
  for (const double reach : {1.5, 2.1, 3.0, 100.0})
    if (auto found = quadratic_shares(plate, k, reach)) return *found;
  GradientShares linear;
  const auto& families = plate.families;
  Eigen::MatrixXd basis(Eigen::Index(families.first[k + 1] - families.first[k]), 2);
  for (auto b = families.first[k]; b < families.first[k + 1]; ++b) {
    basis.row(Eigen::Index(linear.bonds.size())) = families.vectors[families.vector_id[b]].transpose();
    linear.bonds.push_back(static_cast<std::uint32_t>(b));
  }
  linear.share = basis.completeOrthogonalDecomposition().pseudoInverse();
  return linear;
}

/// theta and shear gradients of a field at a point.
struct Strains {
  Eigen::Matrix2d psi;    // row: psi_x, psi_y; column: d/dx, d/dy
  Point gamma;
};

class DomainIntegral : public EnergyRelease {
public:
  DomainIntegral(const BondedPlate& plate, const TipFrame& frame, const Ring& ring)
      : plate_(plate), ahead_(frame.ahead) {
    for (const auto k : points_of(plate, frame, ring, 0)) {
      const Point x = plate.positions[k] - frame.origin;
      const double slope = ring.slope(x.norm());
      if (slope == 0) continue;
      points_.push_back({k, plate.areas[k] * slope * x / x.norm(), gradient_shares(plate, k)});
    }
  }

  double operator()(const State& u, const State& v) const override {
    const double D = plate_.section.bending_stiffness(), nu = plate_.section.poisson, S = plate_.section.shear_stiffness();
    const auto moments = [&](const Eigen::Matrix2d& psi) -> Eigen::Matrix2d {
      const Eigen::Matrix2d kappa = (psi + psi.transpose()) / 2;
      return D * ((1 - nu) * kappa + nu * kappa.trace() * Eigen::Matrix2d::Identity());
    };
    double sum = 0;
    for (const auto& point : points_) {
      const Strains a = strains(point, u), b = strains(point, v);
      const Eigen::Matrix2d M_a = moments(a.psi), M_b = moments(b.psi);
      const double energy = (M_a.cwiseProduct(b.psi).sum() + S * a.gamma.dot(b.gamma)) / 2;
      const auto flux = [&](const Eigen::Matrix2d& M, const Strains& shear, const State& state, const Strains& other) -> Point {
        const auto k = static_cast<Eigen::Index>(point.k);
        const double w_slope = (other.gamma + Point(-state(2, k), state(1, k))).dot(ahead_);
        return M * (other.psi * ahead_) + S * shear.gamma * w_slope;
      };
      const Point carried = (flux(M_a, a, v, b) + flux(M_b, b, u, a)) / 2;
      sum += point.slope.dot(carried - energy * ahead_);
    }
    return sum;
  }

private:
  struct RingPoint {
    std::uint32_t k;
    Point slope;  // area times grad q
    GradientShares shares;
  };

  Strains strains(const RingPoint& point, const State& state) const {
    Strains result{Eigen::Matrix2d::Zero(), Point(0, 0)};
    const auto own = at(state, point.k);
    for (std::size_t i = 0; i < point.shares.bonds.size(); ++i) {
      const auto b = point.shares.bonds[i];
      const auto other = at(state, plate_.families.neighbour[b]);
      const Point share = point.shares.share.col(Eigen::Index(i));
      result.psi += Point(-(other.theta_y - own.theta_y), other.theta_x - own.theta_x) * share.transpose();
      result.gamma += share * shear_difference(plate_.shapes[plate_.families.vector_id[b]], own, other);
    }
    return result;
  }

  BondedPlate plate_;
  Point ahead_;
  std::vector<RingPoint> points_;
};

}  // namespace

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

std::unique_ptr<EnergyRelease> moved_bonds(const BondedPlate& plate, const TipFrame& frame, const Ring& ring) {
  return std::make_unique<MovedBonds>(plate, frame, ring);
}

std::unique_ptr<EnergyRelease> domain_integral(const BondedPlate& plate, const TipFrame& frame, const Ring& ring) {
  return std::make_unique<DomainIntegral>(plate, frame, ring);
}

}  // namespace post
