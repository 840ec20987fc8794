#include "plate/bonds/family_weights.hpp"

#include <Eigen/Geometry>
#include <numbers>
#include <random>

#include "plate/bonds/horizon_parameters.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;
using geometry::Point;

namespace {

/// Energy per area of a family in constant curvature (kappa xx, yy, xy of psi) and constant shear.
double aware_energy(const FamilyWeights& weights, const std::vector<FamilyBond>& bonds, const Eigen::Matrix2d& kappa,
                    const Point& gamma) {
  double theta = 0, sum = 0;
  for (std::size_t i = 0; i < bonds.size(); ++i) {
    const Point& xi = bonds[i].vector;
    const double curvature = xi.dot(kappa * xi) / xi.norm(), shear = gamma.dot(xi);
    theta += weights.bonds[i].D * curvature;
    sum += weights.bonds[i].B * curvature * curvature + weights.bonds[i].S * shear * shear;
  }
  return weights.a * theta * theta + sum;
}

double exact(const Section& s, const Eigen::Matrix2d& kappa, const Point& gamma) {
  const double D = s.bending_stiffness(), nu = s.poisson;
  return D / 2 * ((1 - nu) * kappa.squaredNorm() + nu * kappa.trace() * kappa.trace()) +
         s.shear_stiffness() / 2 * gamma.squaredNorm();
}

std::vector<FamilyBond> full(double ratio, double angle = 0) {
  Discretization d;
  d.spacing = 1, d.horizon_ratio = ratio;
  std::vector<FamilyBond> bonds;
  for (const auto& xi : full_family(d))
    bonds.push_back({Eigen::Rotation2Dd(angle) * xi, d.horizon() / xi.norm() * volume_share(d, xi)});
  return bonds;
}

/// The bonds that a straight face at `distance` beyond the point leaves.
std::vector<FamilyBond> cut(const std::vector<FamilyBond>& bonds, const Point& normal, double distance) {
  std::vector<FamilyBond> left;
  for (const auto& bond : bonds)
    if (bond.vector.dot(normal) < distance) left.push_back(bond);
  return left;
}

const Eigen::Matrix2d states[] = {
    Eigen::Vector2d(1, 0).asDiagonal().toDenseMatrix(), Eigen::Vector2d(0, 1).asDiagonal().toDenseMatrix(),
    (Eigen::Matrix2d() << 0, 1, 1, 0).finished(), (Eigen::Matrix2d() << 0.3, -0.7, -0.7, 0.8).finished()};
const Point shears[] = {{1, 0}, {0, 1}, {0.6, -0.3}, {0, 0}};

}  // namespace

TEST_CASE("position-aware weights: every constant state has the plate's energy, whole and beside a face") {
  for (const double nu : {-0.9, 0.0, 0.3, 0.499})
    for (const double ratio : {2.015, 3.015, 4.015})
      for (const double angle : {0.0, 0.3, std::numbers::pi / 4})
        for (const double distance : {100.0, 2.5, 1.5, 0.5}) {
          const Section s{1000, nu, 0.7, 5.0 / 6, 1};
          const auto bonds = cut(full(ratio, angle), Point(0, 1), distance);
          const auto weights = position_aware(s, bonds);
          CAPTURE(nu, ratio, angle, distance, int(weights.match));
          double worst = 0;
          for (const auto& kappa : states)
            for (const auto& gamma : shears)
              worst =
                  std::max(worst, std::abs(aware_energy(weights, bonds, kappa, gamma) / exact(s, kappa, gamma) - 1));
          if (weights.match == Match::exact)
            CHECK(worst < 1e-11);  // measured: below 1e-12
          else
            CHECK(distance < 1);  // only the outermost row may need what it cannot have
          for (const auto& bond : weights.bonds) {
            CHECK(bond.B >= 0);
            CHECK(bond.S >= 0);
          }
        }
}

TEST_CASE("position-aware weights: no bond curvatures have negative energy, nor do too few bonds") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto whole = full(3.015);
  std::size_t exact_count = 0, other_count = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<FamilyBond> bonds;
    const double keep = uniform(random);
    for (const auto& bond : whole)
      if (uniform(random) > keep) bonds.push_back(bond);
    for (const double nu : {-0.9, 0.0, 0.3, 0.499}) {
      const Section s{1000, nu, 0.7, 5.0 / 6, 1};
      const auto weights = position_aware(s, bonds);
      weights.match == Match::exact ? ++exact_count : ++other_count;
      double theta = 0, sum = 0;
      for (const auto& bond : weights.bonds) {
        CHECK(bond.B >= 0);
        CHECK(bond.S >= 0);
        const double curvature = uniform(random);
        theta += bond.D * curvature;
        sum += bond.B * curvature * curvature;
      }
      CHECK(weights.a * theta * theta + sum >= -1e-12 * sum);
      if (!bonds.empty()) {  // isotropic bending is exact for all
        const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
        CHECK(aware_energy(weights, bonds, one, {0, 0}) == Approx(exact(s, one, {0, 0})).epsilon(1e-10));
      }
    }
  }
  CHECK(exact_count > 100);
  CHECK(other_count > 100);
}

TEST_CASE("position-aware weights turn with the family") {
  const Section s{1000, 0.3, 0.7, 5.0 / 6, 1};
  const auto bonds = cut(full(3.015), Point(0.6, 0.8), 0.7);
  const auto weights = position_aware(s, bonds);
  auto turned = bonds;
  for (auto& bond : turned) bond.vector = Eigen::Rotation2Dd(0.83) * bond.vector;
  const auto again = position_aware(s, turned);
  REQUIRE(bonds.size() > 10);
  for (std::size_t i = 0; i < bonds.size(); ++i) {
    CHECK(again.bonds[i].B == Approx(weights.bonds[i].B).epsilon(1e-9).margin(1e-9));
    CHECK(again.bonds[i].D == Approx(weights.bonds[i].D).epsilon(1e-9).margin(1e-9));
    CHECK(again.bonds[i].S == Approx(weights.bonds[i].S).epsilon(1e-9).margin(1e-9));
  }
}

TEST_CASE("position-aware weights of a plate: every point is counted once") {
  auto d = small_plate::spaced(0.1);
  auto outline = geometry::rectangle(0, 0, 1.1, 0.9);
  outline.holes.push_back(geometry::Circle{{0.5, 0.4}, 0.17, "hole"});
  const auto m = small_plate::model(outline, {{SupportKind::clamped, {"left"}, {}}}, d);
  const auto& areas = m.boundary.cloud.areas;
  const auto kinds = family_kinds(m.plate.families(), areas, m.boundary.active);
  const auto found =
      position_aware(m.plate.families(), m.plate.shapes(), areas, m.boundary.active, kinds, small_plate::section);
  CHECK(found.counts.exact + found.counts.blended + found.counts.arbitrary_horizon == m.boundary.cloud.plate_points);
  CHECK(found.counts.exact > found.counts.blended);
  CHECK(kinds.example.size() < m.plate.points());
}

TEST_CASE("position-aware weights in the plane: every constant strain has its energy, and no bond resists w") {
  for (const double nu : {-0.9, 0.0, 0.3, 0.499})
    for (const double ratio : {2.015, 3.015, 4.015})
      for (const double distance : {100.0, 2.5, 1.5, 0.5}) {
        Section s{1000, nu, 0.7, 5.0 / 6, 1};
        s.law = PlateLaw::membrane;
        const auto bonds = cut(full(ratio), Point(0, 1), distance);
        const auto weights = position_aware(s, bonds);
        CAPTURE(nu, ratio, distance, int(weights.match));
        for (const auto& bond : weights.bonds) CHECK(bond.S == 0);
        if (weights.match != Match::exact) continue;
        for (const auto& kappa : states)
          CHECK(aware_energy(weights, bonds, kappa, {1, 2}) == Approx(exact(s, kappa, {1, 2})).epsilon(1e-11));
      }
}

TEST_CASE("few directions in the plane: isotropic strain has its energy, and no bond resists w") {
  Section s{1000, 0.3, 0.7, 5.0 / 6, 1};
  s.law = PlateLaw::membrane;
  const std::vector<FamilyBond> bonds{{{1, 0}, 1}, {{-1, 0}, 1}, {{0, 1}, 1}, {{0, -1}, 1}};
  const auto weights = position_aware(s, bonds);
  CHECK(weights.match == Match::arbitrary_horizon);
  for (const auto& bond : weights.bonds) CHECK(bond.S == 0);
  const Eigen::Matrix2d same = Eigen::Matrix2d::Identity();
  CHECK(aware_energy(weights, bonds, same, {0, 0}) == Approx(exact(s, same, {0, 0})).epsilon(1e-12));
}
