// Quasi-static growth on plates that are given as formulas: compliance against crack length.
#include "fracture/growth/quasi_static_tips.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "fracture/growth/growth.hpp"
#include "plate/formulation/constraints.hpp"
#include "tests/catch.hpp"

using namespace fracture;
using Catch::Contains;

namespace {

const plate::Section section{1000, 0.3, 0.5, 5.0 / 6, 0};  // toughness: half the fracture energy
constexpr double tip_spacing = 0.01;

/// A crack from the left edge of [0, 6] x [-1, 1]. compliance(a) and its derivative.
struct Formula {
  std::function<double(double)> compliance, slope;
  Factors factors{1, 0, 0};

  LoadedPlate operator()(const std::vector<geometry::Polyline>& cracks) const {
    const double a = geometry::length(cracks[0]);
    const geometry::Point end = cracks[0].back();
    if (a >= 6) return {"the crack reached the right edge", 0, {}};
    return {"", compliance(a), {{{end, {1, 0}, 0, true}, factors, slope(a) / 2}}};
  }
};

using Solve = std::function<LoadedPlate(const std::vector<geometry::Polyline>& cracks)>;

/// Tips of a plate that is a formula: nothing is solved, and there is nothing to draw.
class FormulaTips : public QuasiStaticTips {
public:
  FormulaTips(const Growth& growth, const geometry::Outline& outline, std::vector<geometry::Polyline> cracks,
              Solve solve)
      : QuasiStaticTips(growth, section, outline, tip_spacing, std::move(cracks)), solve_(std::move(solve)) {}

  const plate::Formulation& plate() const override { throw std::logic_error("a formula has no points"); }
  const plate::Constraints& constraints() const override { return constraints_; }
  const plate::State& state() const override { throw std::logic_error("a formula has no state"); }
  const plate::StaticSolution& solution() const override { throw std::logic_error("a formula is not solved"); }
  std::optional<std::vector<post::Srif>> factors(double) override { return std::nullopt; }
  plate::Mesh draw(post::Frame&, const plate::State&) const override { return {}; }

private:
  LoadedPlate full_load(const std::vector<geometry::Polyline>& cracks) override { return solve_(cracks); }

  Solve solve_;
  plate::Constraints constraints_;
};

struct Result {
  std::string outcome;
  std::size_t advances;
  Ledger ledger;
  std::vector<geometry::Polyline> cracks;
};

Result grown(const Growth& growth, const geometry::Outline& outline, std::vector<geometry::Polyline> cracks,
             Solve solve, const std::function<void(const Equilibrium&, const FormulaTips&)>& observe) {
  FormulaTips tips(growth, outline, std::move(cracks), std::move(solve));
  const auto found = grow_quasi_statically(growth, tips, [&](const Equilibrium& state) { observe(state, tips); });
  for (std::size_t c = 0; c < tips.cracks().size(); ++c) {  // what is drawn is what has grown, the last piece too
    const auto& line = tips.record().cracks.lines.at(c);
    CHECK(line.vertices.front() == tips.cracks()[c].front());
    CHECK(line.vertices.back() == tips.cracks()[c].back());
    CHECK(geometry::length(line.vertices) == Approx(geometry::length(tips.cracks()[c])));
    REQUIRE(line.advances.size() == line.vertices.size());
    const auto first = std::ranges::find(line.advances, 0.0);
    CHECK(std::is_sorted(first, line.advances.end()));
    CHECK(std::is_sorted(line.advances.begin(), first, std::greater()));
  }
  return {fracture::in_words(found.ended, false), tips.advances(), found.ledger, tips.cracks()};
}

struct Way {
  Result grown;
  std::vector<double> length, factor, displacement, released;
  std::vector<bool> stable;
};

Way grown(Growth growth, const Formula& formula, double a) {
  Way way;
  growth.fracture_energy = 1 / section.thickness;  // toughness 1
  way.grown = grown(growth, geometry::rectangle(0, -1, 6, 1), {{{0, 0}, {a, 0}}}, formula,
                    [&](const Equilibrium& state, const FormulaTips& tips) {
                      way.length.push_back(geometry::length(tips.cracks()[0]));
                      way.factor.push_back(state.factor);
                      way.displacement.push_back(state.displacement);
                      way.released.push_back(state.ledger.released());
                      way.stable.push_back(state.stable);
                    });
  return way;
}

/// As a beam split along its middle: C = 2 a^3.
const Formula split_beam{[](double a) { return 2 * a * a * a; }, [](double a) { return 6 * a * a; }};
/// G falls with the length: C = sqrt a.
const Formula held_crack{[](double a) { return 8 * std::sqrt(a); }, [](double a) { return 4 / std::sqrt(a); }};

}  // namespace

TEST_CASE("quasi-static growth: the load follows the crack, and the energy goes into it") {
  Growth growth;
  growth.control = Growth::Control::equilibrium;
  growth.max_length = 1.5;
  const auto way = grown(growth, split_beam, 1);
  CHECK(way.grown.outcome == "the largest length of a crack");
  CHECK(way.grown.advances == 50);
  REQUIRE(way.length.size() == 51);
  for (std::size_t i = 0; i < way.length.size(); ++i) {
    CHECK(way.factor[i] == Approx(std::sqrt(2 / (6 * way.length[i] * way.length[i]))));
    CHECK(way.displacement[i] == Approx(way.factor[i] * 2 * std::pow(way.length[i], 3)));
    CHECK(way.stable[i] == (i == 0));
  }
  CHECK(way.grown.ledger.fracture == Approx(0.5));
  CHECK(std::abs(way.grown.ledger.released()) < 1e-4 * way.grown.ledger.fracture);  // trapezoids of a smooth curve
}

TEST_CASE("quasi-static growth: the last piece ends at the largest length") {
  Growth growth;
  growth.control = Growth::Control::equilibrium;
  growth.max_length = 1.5, growth.increment = 7;  // of 0.01 each
  const auto way = grown(growth, split_beam, 1);
  CHECK(way.grown.outcome == "the largest length of a crack");
  CHECK(way.grown.advances == 8);
  CHECK(way.length.back() == Approx(1.5).epsilon(1e-12));
}

TEST_CASE("quasi-static growth: under load the crack jumps, and what it does not take is released") {
  const auto way = grown({}, split_beam, 1);
  CHECK_THAT(way.grown.outcome, Contains("the plate split: the crack reached the right edge"));
  CHECK(way.grown.cracks[0].back().x() == Approx(6));
  CHECK(way.stable.front());
  CHECK_FALSE(way.stable.back());
  for (const double factor : way.factor) CHECK(factor == Approx(std::sqrt(1.0 / 3)));
  CHECK(way.released.back() > way.released.front());
  // constant load P: of the work P^2 dC half goes into strain
  const double a = way.length.back(), P2 = 1.0 / 3;
  CHECK(way.released.back() == Approx(P2 * (2 * a * a * a - 2) / 2 - (a - 1)));
}

TEST_CASE("quasi-static growth: the same crack grows stably with the displacement, until that is all") {
  Growth growth;
  growth.control = Growth::Control::displacement;
  Formula stiff = split_beam;
  const auto way = grown(growth, stiff, 1);
  CHECK(way.grown.outcome == "arrested under the whole load");
  const double a = way.length.back();
  CHECK(way.displacement.back() == Approx(2));  // of the whole load on the first crack
  // q = P C = 2, P^2 C' / 2 = 1: a^4 = 3
  CHECK(a == Approx(std::pow(3, 0.25)).margin(tip_spacing));
  for (std::size_t i = 1; i + 1 < way.length.size(); ++i) CHECK(way.stable[i]);
  CHECK(std::abs(way.grown.ledger.released()) < 0.02 * way.grown.ledger.fracture);
}

TEST_CASE("quasi-static growth: stable under load where the energy release falls with the length") {
  const auto way = grown({}, held_crack, 1);
  CHECK(way.grown.outcome == "arrested under the whole load");
  CHECK(way.length.back() == Approx(4).margin(tip_spacing));  // factor 1: G = 2 / sqrt a = 1
  CHECK(std::all_of(way.stable.begin(), way.stable.end(), [](bool s) { return s; }));
}

TEST_CASE("quasi-static growth: what keeps a tip where it is") {
  Growth growth;
  Formula formula = split_beam;
  SECTION("too little load") {
    formula.slope = [](double) { return 1.9; };
    CHECK(grown(growth, formula, 1).grown.outcome == "no growth under the whole load");
  }
  SECTION("a zone in which nothing fails") {
    growth.no_fail.push_back({1.2, -0.1, 1.5, 0.1});
    const auto way = grown(growth, formula, 1);
    CHECK(way.grown.outcome == "no tip can grow");
    CHECK(way.length.back() == Approx(1.2).margin(1e-9));
  }
  SECTION("compression of the z > 0 face") {
    formula.factors.K1 = -1;
    CHECK(grown(growth, formula, 1).grown.advances > 0);
    growth.tension_only = true;
    CHECK(grown(growth, formula, 1).grown.outcome == "no tip can grow");
  }
  SECTION("the number of advances") {
    growth.max_advances = 7;
    CHECK(grown(growth, formula, 1).grown.outcome == "the largest number of advances");
    CHECK(grown(growth, formula, 1).length.back() == Approx(1.07));
  }
}

TEST_CASE("quasi-static growth: a tip that meets no ring any more breaks through to what is nearest") {
  std::size_t calls = 0;
  const auto solve = [&](const std::vector<geometry::Polyline>& cracks) -> LoadedPlate {
    if (++calls == 1) return {"", 1, {{{cracks[0].back(), {1, 0}, 0, true}, {}, std::nullopt}}};
    return {"", 1, {}};
  };
  Growth growth;
  growth.fracture_energy = 1;
  const auto found = grown(growth, geometry::rectangle(0, -1, 4, 1), {{{0, 0.7}, {1, 0.97}}}, solve,
                           [](const Equilibrium&, const FormulaTips&) {});
  CHECK(found.outcome == "no tip is left");
  CHECK((found.cracks[0].back() - geometry::Point(1, 1)).norm() < 1e-12);
  CHECK(found.ledger.fracture == Approx(0.5 * 0.03));
}

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
  CHECK(found.cracks[1].back().x() == Approx(0.5 + tip_spacing));
  CHECK(found.cracks[0].front().x() == Approx(1.5 - tip_spacing));
  CHECK(found.cracks[0].back().x() == Approx(2.5 + tip_spacing));
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
  CHECK_THAT(found.outcome, Contains("stopped: not resolved: the tip at (1.5, 0) would turn by"));
  CHECK_THAT(found.outcome, Contains("`direction` = \"straight\""));
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
  CHECK_THAT(found.outcome, Contains("stopped: not resolved: the tip at (1.5, 0) would turn by"));
  CHECK_THAT(found.outcome, Contains("5 spacings on by"));
  CHECK(found.advances == 0);
  CHECK(found.ledger.fracture == 0);
  CHECK(geometry::length(found.cracks[0]) == Approx(1));
}

TEST_CASE("quasi-static growth: a piece is laid longer until its end tells its direction, alike for mirror images") {
  const auto first_piece = [](double known_from, double side) {
    const auto found = grown_by_two(
        [&](std::size_t i, LoadedTip& tip) {
          const bool first = tip.tip.direction.y() == 0;  // before the first turn
          const double piece = (tip.tip.position - geometry::Point(i == 0 ? 1.5 : 2.5, 0)).norm();
          tip.factors.K2 = first ? (i == 0 ? 1 : -1) * side * 0.3 : 0;
          if (!first && piece < known_from * tip_spacing * (1 - 1e-9)) tip.errors = {1, 1, 1};
        },
        1);
    CHECK(found.ledger.fracture == Approx(geometry::length(found.cracks[0]) - 1));  // toughness 1
    const auto& crack = found.cracks[0];
    const geometry::Point front = crack.front() - geometry::Point(1.5, 0),
                          back = crack.back() - geometry::Point(2.5, 0);
    // measured 1.2e-9: angles are sought to 1e-10
    CHECK((front + geometry::Point(back.x(), -back.y())).norm() < 1e-8);  // mirror images about x = 2
    return back;
  };
  for (const double side : {-1.0, 1.0}) {
    CHECK(first_piece(0, side).norm() == Approx(5 * tip_spacing));
    CHECK(first_piece(6, side).norm() == Approx(7.5 * tip_spacing));
    CHECK(first_piece(10, side).norm() == Approx(10 * tip_spacing));
    CHECK(first_piece(11, side).norm() == Approx(5 * tip_spacing));  // no length serves
    CHECK(side * first_piece(6, side).y() > 0);
  }
}

TEST_CASE("quasi-static growth: what a longer piece asks for after its turn contradicts it earlier") {
  const auto outcome = [](double known_from) {
    return grown_by_two(
               [&](std::size_t i, LoadedTip& tip) {
                 const bool first = tip.tip.direction.y() == 0;
                 const double piece = (tip.tip.position - geometry::Point(i == 0 ? 1.5 : 2.5, 0)).norm();
                 tip.factors.K2 = 0.45;  // 36 degrees
                 if (!first && piece < known_from * tip_spacing * (1 - 1e-9)) tip.errors = {1, 1, 1};
               },
               1)
        .outcome;
  };
  CHECK_THAT(outcome(0), !Contains("spacings on by"));
  CHECK_THAT(outcome(6), Contains("7.5 spacings on by"));
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
  CHECK(tips.cracks()[0].back().x() == Approx(2.5 + 4 * tip_spacing));
  REQUIRE(tips.warnings().size() == 1);
  CHECK_THAT(tips.warnings()[0], Contains("no room for an energy release rate"));
  const auto& rows = tips.record().tips;
  CHECK(rows.rows[1][rows.column("tip")] == post::Cell(1.0));
  CHECK(rows.rows[0][rows.column("G")] == post::Cell());
}
