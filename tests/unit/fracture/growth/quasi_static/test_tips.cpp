// Quasi-static growth on plates that are given as formulas: compliance against crack length.
#include "tests/unit/fracture/growth/quasi_static/formula_tips.hpp"

using namespace formula_tips;
using Catch::Matchers::Contains;

namespace {

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
  CHECK(a == Approx(std::pow(3, 0.25)).margin(spacing));
  for (std::size_t i = 1; i + 1 < way.length.size(); ++i) CHECK(way.stable[i]);
  CHECK(std::abs(way.grown.ledger.released()) < 0.02 * way.grown.ledger.fracture);
}

TEST_CASE("quasi-static growth: stable under load where the energy release falls with the length") {
  const auto way = grown({}, held_crack, 1);
  CHECK(way.grown.outcome == "arrested under the whole load");
  CHECK(way.length.back() == Approx(4).margin(spacing));  // factor 1: G = 2 / sqrt a = 1
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
