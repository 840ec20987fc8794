#include "plate/galerkin/stiffness.hpp"

#include "plate/galerkin/families.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"

using namespace plate;
namespace gp = galerkin_plate;

TEST_CASE("family stiffness: the energy of every family, of any state, and none of its own for a rigid one") {
  for (const auto& cells : gp::scenes()) {
    const auto families = gp::families(cells);
    const State u = gp::random_state(cells.positions.size(), 6);
    for (std::size_t k = 0; k < cells.positions.size(); k += 3) {
      const auto K = family_stiffness(families, gp::section, k);
      Eigen::VectorXd own(K.rows()), rigid(K.rows());
      const auto take = [&](Eigen::Index member, std::size_t i) {
        own.segment<3>(3 * member) = u.col(Eigen::Index(i));
        rigid.segment<3>(3 * member) << 2 + 3 * cells.positions[i].x() - cells.positions[i].y(), -1, -3;
      };
      take(0, k);
      for (std::size_t i = 0; i < families.families[k].size(); ++i)
        take(Eigen::Index(i + 1), families.families[k][i].neighbour);
      const double expected = family_energy(families, gp::section, k, u);
      CHECK(own.dot(K * own) / 2 == Approx(expected).epsilon(1e-11));  // measured: 3e-14
      CHECK((K * rigid).norm() < 1e-12 * K.norm() * rigid.norm());     // measured: 2e-15
      CHECK((K - K.transpose()).norm() < 1e-14 * K.norm());
    }
  }
}

TEST_CASE("family stiffness: more neighbours than it has room for are refused") {
  GalerkinFamilies families = gp::families(gp::scenes().front());
  std::size_t most = 0;
  for (std::size_t k = 1; k < families.areas.size(); ++k)
    if (families.families[k].size() > families.families[most].size()) most = k;
  std::vector<geometry::Families::Step> steps;
  for (std::int32_t i = 1; i <= 33; ++i) steps.push_back({i, 0});
  families.families.set(std::uint32_t(most), steps);
  const PointSections sections(gp::section);
  FamilyStiffness stiffness(families, sections);
  CHECK_THROWS_AS(stiffness.find(most), std::invalid_argument);
}
