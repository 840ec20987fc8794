// How well the next advance is known, of two tips that are given.
#include "tests/unit/fracture/growth/quasi_static/formula_tips.hpp"

using namespace formula_tips;
using Catch::Matchers::Contains;

namespace {

/// A plate of two tips at the ends of a crack, alike but for what the test changes.
LoadedPlate two_tips(const std::vector<geometry::Polyline>& cracks,
                     const std::function<void(std::size_t, LoadedTip&)>& change) {
  LoadedPlate plate{"", 1, {}};
  for (const bool back : {false, true}) {
    const auto& crack = cracks[0];
    const geometry::Point end = back ? crack.back() : crack.front(), before = back ? crack[crack.size() - 2] : crack[1];
    LoadedTip tip{{end, (end - before).normalized(), 0, back}, {1, 0, 0}, 2.0, {0.01, 0.01, 0.01}, 0.01};
    change(back, tip);
    plate.tips.push_back(tip);
  }
  return plate;
}

Result grown_by_two(
    const std::function<void(std::size_t, LoadedTip&)>& change, std::size_t advances,
    const std::function<void(const Equilibrium&)>& see = [](const auto&) {}) {
  Growth growth;
  growth.fracture_energy = 1 / section.thickness, growth.max_advances = advances;
  growth.control = Growth::Control::equilibrium;
  return grown(
      growth, geometry::rectangle(0, -1, 4, 1), {{{1.5, 0}, {2.5, 0}}},
      [&](const auto& cracks) { return two_tips(cracks, change); },
      [&](const Equilibrium& state, const FormulaTips&) { see(state); });
}

}  // namespace

TEST_CASE("quasi-static growth: mirror images at the edge of what goes on together stay together") {
  Growth growth;
  growth.fracture_energy = 1 / section.thickness, growth.max_advances = 1;
  growth.control = Growth::Control::equilibrium;
  const auto solve = [](const std::vector<geometry::Polyline>& cracks) {
    auto plate =
        two_tips(cracks, [](std::size_t i, LoadedTip& tip) { tip.G = 2 * 0.99 * (1 + (i == 0 ? 1 : -1) * 1e-12); });
    plate.tips.push_back({{cracks[1].back(), {1, 0}, 1, true}, {1, 0, 0}, 2.0, {0.01, 0.01, 0.01}, 0.01});
    return plate;
  };
  const auto found = grown(growth, geometry::rectangle(0, -1, 4, 1), {{{1.5, 0}, {2.5, 0}}, {{0, 0.5}, {0.5, 0.5}}},
                           solve, [](const Equilibrium&, const FormulaTips&) {});
  CHECK(found.cracks[1].back().x() == Approx(0.5 + spacing));
  CHECK(found.cracks[0].front().x() == Approx(1.5 - spacing));
  CHECK(found.cracks[0].back().x() == Approx(2.5 + spacing));
}

TEST_CASE("quasi-static growth: a turn within its error is left away, alike at both tips") {
  const auto turning = [](double error) {
    return [error](std::size_t i, LoadedTip& tip) { tip.factors.K2 = (i == 0 ? 1 : -1) * 0.05, tip.errors.K2 = error; };
  };
  CHECK(grown_by_two(turning(0.06), 1).cracks[0].back().y() == 0);
  const auto turned = grown_by_two(turning(0.01), 1).cracks[0];
  CHECK(turned.back().y() > 0.003);
  CHECK(turned.front().y() == Approx(turned.back().y()));
}

TEST_CASE("quasi-static growth: it ends, with the reason, where a direction is not resolved") {
  std::vector<Equilibrium> seen;
  const auto see = [&](const Equilibrium& state) { seen.push_back(state); };
  const auto found = grown_by_two(
      [](std::size_t, LoadedTip& tip) {
        tip.factors.K2 = 0.5, tip.errors = {0.05, 1, 1}, tip.release_error = 0.05;
      },
      9, see);
  CHECK_THAT(found.outcome, Contains("the next advance is not resolved: the tip at (1.5, 0) would turn by"));
  CHECK_THAT(found.outcome, Contains("growth.direction = \"straight\""));
  CHECK(found.advances == 0);
  REQUIRE(seen.size() == 1);
  CHECK(seen[0].ends);
  CHECK(seen[0].critical == Approx(std::sqrt(0.5)));
  CHECK(seen[0].critical_error == Approx(0.05));
  const auto unknown = grown_by_two([](std::size_t, LoadedTip& tip) { tip.release_error = 1.2; }, 9);
  CHECK_THAT(unknown.outcome, Contains("the energy release rate at the tip at (1.5, 0) is not known"));
}

TEST_CASE("quasi-static growth: an end of a piece that asks for another large turn ends it where it was") {
  // K2 stays half of K1 whatever the crack does: each piece would turn by 40 degrees more
  const auto found = grown_by_two([](std::size_t, LoadedTip& tip) { tip.factors.K2 = 0.9; }, 9);
  CHECK_THAT(found.outcome, Contains("the next advance is not resolved: the tip at (1.5, 0) would turn by"));
  CHECK_THAT(found.outcome, Contains("five spacings on by"));
  CHECK(found.advances == 0);
  CHECK(found.ledger.fracture == 0);
  CHECK(geometry::length(found.cracks[0]) == Approx(1));
}

TEST_CASE("quasi-static growth: the load factor has the error of whichever tip may be the first") {
  std::vector<double> errors;
  const auto see = [&](const Equilibrium& state) { errors.push_back(state.critical_error); };
  grown_by_two(
      [](std::size_t i, LoadedTip& tip) { tip.G = i == 0 ? 2 : 1.62, tip.release_error = i == 0 ? 0.01 : 0.3; }, 0,
      see);
  REQUIRE(errors.size() == 1);
  CHECK(errors[0] == Approx(0.9 * 1.3 - 1));  // the root of the second is 0.9 of the first's
}

TEST_CASE("quasi-static growth: a tip without a ring and without anything ahead stays, and is told of once") {
  Growth growth;
  growth.fracture_energy = 1, growth.max_advances = 4;
  growth.control = Growth::Control::equilibrium;
  const auto outline = geometry::rectangle(0, -1, 4, 1);
  FormulaTips tips(growth, outline, {{{1.5, 0}, {2.5, 0}}}, [](const auto& cracks) {
    return two_tips(cracks, [](std::size_t i, LoadedTip& tip) {
      if (i == 0) tip.G.reset();
    });
  });
  grow_quasi_statically(growth, tips, [](const auto&) {});
  CHECK(tips.cracks()[0].front().x() == 1.5);
  CHECK(tips.cracks()[0].back().x() == Approx(2.5 + 4 * spacing));
  REQUIRE(tips.warnings().size() == 1);
  CHECK_THAT(tips.warnings()[0], Contains("no room for an energy release rate"));
  const auto& rows = tips.record().tips;
  CHECK(rows.rows[1][rows.column("tip")] == post::Cell(1.0));
  CHECK(rows.rows[0][rows.column("G")] == post::Cell());
}
