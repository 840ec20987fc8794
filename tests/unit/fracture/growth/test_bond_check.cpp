// What single bonds bear: the energy of the plate, and nothing without load.
#include "fracture/growth/bond_failure.hpp"

#include "plate/bonds/rows/lattice_operator.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace fracture;
namespace vp = verified_plate;

namespace {

Growth growth(Growth::Criterion criterion) {
  Growth result;
  result.criterion = criterion;
  result.fracture_energy = 2;
  result.apparent_toughness = 1;
  return result;
}

struct Checked {
  explicit Checked(cases::Case wanted, Growth by = growth(Growth::Criterion::bond_energy))
      : content(std::move(wanted)),
        criterion(std::move(by)),
        whole(vp::assembled(content)),
        damaged(*whole->breaking(), whole->boundary(), {content.section, content.discretization}),
        limits(criterion, content.section, content.discretization),
        check(criterion, limits, damaged, whole->boundary()) {}
  cases::Case content;
  Growth criterion;
  std::unique_ptr<plate::Formulation> whole;
  DamagedPlate damaged;
  BondLimits limits;
  BondCheck check;
};

}  // namespace

TEST_CASE("bond check: the energies of all bonds are the energy of the plate, whatever has broken") {
  Checked plate(vp::cracked_with_hole());
  const auto u = vp::random_state(*plate.whole, 5);
  const auto sum = [&] {
    double total = 0;
    for (const auto& [bond, demand] : plate.check.at_least(-1e300, u)) {
      const auto family = plate.whole->families()[bond[0]];
      const auto& areas = plate.whole->cloud().areas;
      const auto& shape = plate.whole->breaking()->shapes()[family[family.find(bond[1])].vector_id];
      total += demand * plate.limits.energy() * shape.weight * areas[bond[0]] * areas[bond[1]];
    }
    return total;
  };
  CHECK(sum() == Approx(plate.whole->strain_energy(u)));
  const auto most = plate.check.at_least(0.9 * plate.check.largest(u), u);
  REQUIRE(most.size() >= 1);
  CHECK(most.front().demand == Approx(plate.check.largest(u)));
  plate.damaged.break_bonds({most.front().bond}, 1);
  const double drop = plate.damaged.carry_on_all({u, {}, 0});
  CHECK(sum() == Approx(plate.whole->strain_energy(u) - drop));
  for (const auto& one : plate.check.at_least(-1e300, u)) CHECK(one.bond != most.front().bond);
}

TEST_CASE(
    "bond check: without load nothing fails, with every surface correction and criterion, a pre-crack is no damage") {
  using plate::SurfaceCorrection;
  for (const auto correction : {SurfaceCorrection::none, SurfaceCorrection::volume,
                                SurfaceCorrection::arbitrary_horizon, SurfaceCorrection::position_aware})
    for (const auto criterion : {Growth::Criterion::bond_energy, Growth::Criterion::curvature_shear}) {
      auto content = vp::cracked_with_hole();
      content.discretization.surface_correction = correction;
      Checked plate(content, growth(criterion));
      const plate::State rest = plate::State::Zero(3, vp::size(*plate.whole));
      CHECK(plate.check.largest(rest) == 0);
      CHECK(plate.check.suspects(rest).empty());
      CHECK(plate.damaged.broken().count() == 0);
      // under a uniform curvature no bond at an edge or a crack is loaded out of all proportion
      plate::State bent = rest;
      for (Eigen::Index k = 0; k < bent.cols(); ++k) {
        const auto& x = plate.whole->cloud().positions[std::size_t(k)];
        bent.col(k) << x.squaredNorm() / 2, x.y(), -x.x();
      }
      std::vector<double> demands;
      for (const auto& one : plate.check.at_least(-1e300, bent)) demands.push_back(one.demand);
      std::ranges::sort(demands);
      CHECK(demands.back() < 5 * demands[demands.size() / 2]);  // measured 1.0 to 4.8
    }
}

TEST_CASE("bond check: bonds that fail are among the suspects") {
  auto content = vp::square(0.05);
  content.cracks = {{{-0.4, 0.013}, {0.3, 0.21}}};
  content.supports = {vp::held_all_round(plate::SupportKind::clamped)};
  Checked plate(content);
  const auto solution = vp::solved(*plate.whole, 1e-8);
  const plate::State u = std::sqrt(1.2 / plate.check.largest(solution.state)) * solution.state;
  const auto failing = plate.check.at_least(1, u);
  REQUIRE(failing.size() >= 2);
  const auto suspects = plate.check.suspects(u);
  CHECK(suspects.size() < 0.6 * vp::size(*plate.whole));
  const auto found = plate.check.at_least(1, u, suspects);
  REQUIRE(found.size() == failing.size());
  for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i].bond == failing[i].bond);
}
