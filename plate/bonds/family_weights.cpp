#include "plate/bonds/family_weights.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "plate/bonds/horizon_parameters.hpp"
#include "plate/model/dense_algebra.hpp"

namespace plate {
namespace {

/// Eigenvalue ratio below which a family has too few directions.
constexpr double least_rank = 1e-6;

/// 1, cos 2 phi, sin 2 phi, cos 4 phi, sin 4 phi: even polynomials of the direction up to the fourth degree.
using Harmonics = Eigen::Matrix<double, 5, 1>;

Harmonics harmonics(const geometry::Point& vector) {
  const double c = vector.x() / vector.norm(), s = vector.y() / vector.norm();
  const double cos2 = c * c - s * s, sin2 = 2 * c * s;
  return {1, cos2, sin2, cos2 * cos2 - sin2 * sin2, 2 * cos2 * sin2};
}

/// The polynomial of `Count` harmonics with sum weight p(n) t(n) = (target, 0, 0, ...), of least norm where the
/// directions cannot tell its coefficients apart (8 directions of a square lattice: sin 4 phi = 0); nothing where there
/// is none.
template <int Count>
std::optional<Eigen::Matrix<double, Count, 1>> polynomial(const std::vector<Harmonics>& t,
                                                          const std::vector<double>& weight, double target) {
  using Square = Eigen::Matrix<double, Count, Count>;
  Square gram = Square::Zero();
  for (std::size_t j = 0; j < t.size(); ++j)
    gram += weight[j] * t[j].template head<Count>() * t[j].template head<Count>().transpose();
  const double scale = gram(0, 0);
  const Eigenpairs eigen = eigenpairs(gram / scale);
  using Vector = Eigen::Matrix<double, Count, 1>;
  const Vector inverse = eigen.values.unaryExpr([](double l) { return l > least_rank ? 1 / l : 0; });
  const Vector wanted = Vector::Unit(0) * (target / scale);
  const Vector p = eigen.vectors * inverse.cwiseProduct(eigen.vectors.transpose() * wanted);
  if ((gram / scale * p - wanted).norm() > least_rank * wanted.norm()) return std::nullopt;
  return p;
}

/// Least weight of a bond, as a share of the arbitrary horizon's: weights of zero would leave hinges.
constexpr double least_weight = 0.1;

/// Largest share t with (1 - t) plain + t p_j >= least_weight plain for all bonds.
template <int Count>
double admissible_share(const std::vector<Harmonics>& t, const Eigen::Matrix<double, Count, 1>& p, double plain) {
  double share = 1;
  for (const auto& direction : t) {
    const double value = p.dot(direction.template head<Count>());
    if (value < least_weight * plain) share = std::min(share, (1 - least_weight) * plain / (plain - value));
  }
  return share;
}

struct Sums {
  double first = 0, second = 0;  // sum omega A xi, omega A xi^2
};

FamilyWeights arbitrary_horizon_weights(const Section& section, std::span<const FamilyBond> bonds, const Sums& sums) {
  const auto p = arbitrary_horizon(section, TwistMatch::frame_invariant, {0, sums.first, sums.second, 0}, 0);
  FamilyWeights result{p.a, {}, Match::arbitrary_horizon};
  // D proportional to B xi: then a theta^2 + sum B (s xi)^2 is positive for every nu > -1, which uniform D is not
  for (const auto& bond : bonds) {
    const double b = p.b * bond.weight;
    result.bonds.push_back({2 * b * bond.vector.norm() / (p.b * sums.second), b, p.C / 4 * bond.weight});
  }
  return result;
}

}  // namespace

FamilyWeights position_aware(const Section& section, std::span<const FamilyBond> bonds) {
  std::vector<Harmonics> t;
  std::vector<double> second;  // omega A xi^2
  Sums sums;
  for (const auto& bond : bonds) {
    const double length = bond.vector.norm();
    t.push_back(harmonics(bond.vector));
    second.push_back(bond.weight * length * length);
    sums.first += bond.weight * length;
    sums.second += second.back();
  }
  if (bonds.empty()) return {0, {}, Match::arbitrary_horizon};

  const double D = section.bending_stiffness(), nu = section.poisson, S = section.shear_stiffness();
  const double curvature = 2 * D * (1 - nu);  // sum B xi^2 of a family without preferred direction
  const auto p_curvature = polynomial<5>(t, second, curvature);
  const auto p_shear = polynomial<3>(t, second, S);
  if (!p_curvature || !p_shear) return arbitrary_horizon_weights(section, bonds, sums);

  const double plain_curvature = curvature / sums.second, plain_shear = S / sums.second;
  const double share_curvature = admissible_share<5>(t, *p_curvature, plain_curvature);
  const double share_shear = admissible_share<3>(t, *p_shear, plain_shear);
  FamilyWeights result;
  result.match = share_curvature < 1 || share_shear < 1 ? Match::blended : Match::exact;
  std::vector<double> b_second;
  double b_sum = 0;
  for (std::size_t j = 0; j < bonds.size(); ++j) {
    const double b = (1 - share_curvature) * plain_curvature + share_curvature * p_curvature->dot(t[j]);
    const double s = (1 - share_shear) * plain_shear + share_shear * p_shear->dot(t[j].head<3>());
    result.bonds.push_back({0, b * bonds[j].weight, s * bonds[j].weight});
    b_second.push_back(result.bonds[j].B * second[j] / bonds[j].weight);
    b_sum += b_second.back();
  }
  result.a = (D * (1 + nu) - b_sum) / 4;  // isotropic bending is exact

  // D = B xi times a polynomial: of all with sum D xi n n = 1 the one with the least sum D^2 / B, so that
  // a theta^2 + sum B (s xi)^2 is positive for every nu > -1
  const auto p_dilatation = polynomial<3>(t, b_second, 2);
  if (!p_dilatation) return arbitrary_horizon_weights(section, bonds, sums);
  double norm = 0;
  for (std::size_t j = 0; j < bonds.size(); ++j) {
    const double p = p_dilatation->dot(t[j].head<3>());
    result.bonds[j].D = result.bonds[j].B * bonds[j].vector.norm() * p;
    norm += b_second[j] * p * p;
  }
  if (result.a < 0 && -result.a * norm >= 1) return arbitrary_horizon_weights(section, bonds, sums);
  return result;
}

PositionAware position_aware(const geometry::Families& families, const std::vector<BondShape>& shapes,
                             const std::vector<double>& areas, const std::vector<char>& active,
                             const FamilyKinds& kinds, const Section& section) {
  PositionAware result;
  result.weights = {kinds.kind, {}, {0}, {}};
  std::vector<Match> match;
  for (const auto k : kinds.example) {
    std::vector<FamilyBond> bonds;
    for (const auto [j, id] : families[k]) bonds.push_back({families.vectors()[id], shapes[id].weight * areas[j]});
    FamilyWeights own = active[k] ? position_aware(section, bonds) : FamilyWeights{};
    own.bonds.resize(bonds.size());  // a point that stores no energy has weights of zero
    result.weights.a.push_back(own.a);
    result.weights.bonds.insert(result.weights.bonds.end(), own.bonds.begin(), own.bonds.end());
    result.weights.first.push_back(result.weights.bonds.size());
    match.push_back(own.match);
  }
  for (std::size_t k = 0; k < kinds.kind.size(); ++k) {
    if (!active[k]) continue;
    switch (match[kinds.kind[k]]) {
      case Match::exact:
        ++result.counts.exact;
        break;
      case Match::blended:
        ++result.counts.blended;
        break;
      case Match::arbitrary_horizon:
        ++result.counts.arbitrary_horizon;
        break;
    }
  }
  return result;
}

namespace {

FamilySums full_sums(const Section& section, const Discretization& d) {
  FamilySums sums;
  const auto vectors = full_family(d);
  const auto shapes = bond_shapes(vectors, section, d);
  for (std::size_t i = 0; i < vectors.size(); ++i)
    add(sums, shapes[i], volume_share(d, vectors[i]), section.thickness, d.spacing * d.spacing);
  return sums;
}

PointParameters scaled(const PointParameters& p, double factor) {
  return {p.a, p.b * factor, p.d * factor, p.C * factor};
}

}  // namespace

ParameterRule::ParameterRule(const Section& section, const Discretization& d)
    : section_(section),
      correction_(d.surface_correction),
      match_(d.twist_match),
      full_(full_sums(section, d)),
      constant_(d.full_horizon == FullHorizon::lattice ? arbitrary_horizon(section, d.twist_match, full_, full_.twist)
                                                       : disc_parameters(section, d.influence, d.horizon())) {}

PointParameters ParameterRule::operator()(const FamilySums& sums) const {
  if (sums.second <= 0) return {};
  switch (correction_) {
    case SurfaceCorrection::none:
      return constant_;
    case SurfaceCorrection::volume:
      return scaled(constant_, full_.volume / sums.volume);
    case SurfaceCorrection::arbitrary_horizon:
    case SurfaceCorrection::position_aware:
      break;
  }
  return arbitrary_horizon(section_, match_, sums, full_.twist);
}

FamilyRule::FamilyRule(const Section& section, const Discretization& discretization)
    : section_(section), discretization_(discretization), parameters_(section, discretization) {}

FamilyWeights FamilyRule::operator()(std::span<const FamilyBond> bonds) const {
  if (discretization_.surface_correction == SurfaceCorrection::position_aware) return position_aware(section_, bonds);
  FamilySums sums;
  for (const auto& bond : bonds) {
    const double length = bond.vector.norm();
    const BondShape shape{bond.vector.y() / length, -bond.vector.x() / length, length, bond.weight};
    const double omega = influence(discretization_.influence, length, discretization_.horizon());
    add(sums, shape, bond.weight / (omega * section_.thickness), section_.thickness, 1);
  }
  const auto p = parameters_(sums);
  FamilyWeights result{p.a, {}, Match::exact};
  for (const auto& bond : bonds) result.bonds.push_back({p.d * bond.weight, p.b * bond.weight, p.C / 4 * bond.weight});
  return result;
}

namespace {

Kinematics<> kinematics(const State& state, std::uint32_t k) {
  return {state(0, k), state(1, k), state(2, k)};
}

double dilatation(const OwnFamily& family, const State& state) {
  const auto own = kinematics(state, family.point);
  double sum = 0;
  for (const auto& bond : family.bonds)
    sum += bond.weights.D * curvature_difference(bond, own, kinematics(state, bond.neighbour));
  return sum;
}

}  // namespace

double energy(const OwnFamily& family, const State& a, const State& b) {
  const auto own_a = kinematics(a, family.point), own_b = kinematics(b, family.point);
  double sum = family.a * dilatation(family, a) * dilatation(family, b);
  for (const auto& bond : family.bonds) {
    const auto other_a = kinematics(a, bond.neighbour), other_b = kinematics(b, bond.neighbour);
    sum += bond.weights.B * curvature_difference(bond, own_a, other_a) * curvature_difference(bond, own_b, other_b) +
           bond.weights.S * shear_difference(bond, own_a, other_a) * shear_difference(bond, own_b, other_b);
  }
  return family.area * sum;
}

void add_force(const OwnFamily& family, const State& state, double share, Forces& forces) {
  const auto own = kinematics(state, family.point);
  const double twice = 2 * share * family.area, q = twice * family.a * dilatation(family, state);
  PointValues sum(0, 0, 0);
  for (const auto& bond : family.bonds) {
    const auto other = kinematics(state, bond.neighbour);
    const double bend = bond.weights.D * q + twice * bond.weights.B * curvature_difference(bond, own, other);
    const double shear = twice * bond.weights.S * shear_difference(bond, own, other);
    const double lever = shear * bond.length / 2, near = bend + lever, far = lever - bend;
    sum += PointValues(shear, bond.mx * near, bond.my * near);
    forces.col(bond.neighbour) += PointValues(-shear, bond.mx * far, bond.my * far);
  }
  forces.col(family.point) += sum;
}

}  // namespace plate
