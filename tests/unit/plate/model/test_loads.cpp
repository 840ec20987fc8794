#include "plate/model/loads.hpp"

#include <set>

#include "tests/catch.hpp"

using namespace plate;
using geometry::Point;

namespace {

/// One load of every kind, with every member given that its kind has.
std::vector<Load> all_kinds() {
  const geometry::Polyline line{{0, 0}, {1, 2}};
  const std::vector<std::string> edges{"left", "top"};
  return {Load{Pressure{.value = 2, .gradient = {3, 4}, .formula = Formula("x + 1"), .gravity = -5, .path = line}},
          Load{EdgeMoment{.edges = edges, .value = 2, .twist = 3, .tensor = {{4, 5, 6}}}},
          Load{EdgeShear{.edges = edges, .value = 2}},
          Load{PointForce{.position = {0.5, 0.25}, .value = 2}},
          Load{LineLoad{.along = line, .value = 2}},
          Load{Temperature{.value = 2, .formula = Formula("x + 1")}},
          Load{Settlement{.support = 1, .value = 2, .slope = {3, 4}, .rotation = 5}},
          Load{EdgeTraction{.edges = edges, .value = 2, .shear = 3, .tensor = {{4, 5, 6}}}},
          Load{BodyForce{.vector = {3, 4}}}};
}

}  // namespace

TEST_CASE("loads: each kind has a name of its own, and nothing given at first") {
  std::set<std::string> names;
  for (const auto& action : Load::kinds()) {
    const Load load{action};
    CAPTURE(load.name());
    CHECK(names.insert(load.name()).second);
    CHECK(load.edges().empty());
    CHECK(load.line().empty());
    CHECK(load.path().empty());
    CHECK(load.speed() == 0);
    CHECK_FALSE(load.formula().given());
    CHECK(load.point().has_value() == (load.name() == "point_force"));
    CHECK_FALSE(load.moves());
  }
  CHECK(names.size() == std::variant_size_v<Load::Action>);
  CHECK(Load{Settlement{}}.name() == "settlement");
}

TEST_CASE("loads: what several kinds have is empty where a kind has none") {
  const auto loads = all_kinds();
  REQUIRE(loads.size() == Load::kinds().size());
  for (const auto& load : loads) {
    const auto name = load.name();
    CAPTURE(name);
    CHECK(load.edges().empty() == (name != "edge_moment" && name != "edge_shear" && name != "edge_traction"));
    CHECK(load.line().empty() == (name != "line_load"));
    CHECK(load.path().empty() == (name != "pressure"));
    CHECK(load.formula().given() == (name == "pressure" || name == "temperature"));
    CHECK(load.point().has_value() == (name == "point_force"));
  }
  const Load moving{PointForce{.value = 1, .path = {{0, 0}, {1, 0}}, .speed = 3}};
  CHECK(moving.moves());
  CHECK(moving.speed() == 3);
  CHECK_FALSE(moving.point());
}

TEST_CASE("loads: twice a load has twice every amount, and the same places") {
  auto loads = all_kinds();
  for (auto& load : loads) {
    scale(load, 2);
    std::visit(
        [](const auto& action) {
          if constexpr (requires { action.value; }) CHECK(action.value == 4);
        },
        load.action);
    if (load.formula().given()) CHECK(load.formula()({3, 0}) == 8);
  }
  const auto& pressure = *loads[0].as<Pressure>();
  CHECK(pressure.gradient == Point(6, 8));
  CHECK(pressure.gravity == -10);
  CHECK(pressure.path[1] == Point(1, 2));
  const auto& moment = *loads[1].as<EdgeMoment>();
  CHECK(moment.twist == 6);
  CHECK(moment.tensor == std::array<double, 3>{8, 10, 12});
  CHECK(loads[3].point() == Point(0.5, 0.25));
  CHECK(loads[4].line()[1] == Point(1, 2));
  const auto& traction = *loads[7].as<EdgeTraction>();
  CHECK(traction.shear == 6);
  CHECK(traction.tensor == std::array<double, 3>{8, 10, 12});
  CHECK(loads[8].as<BodyForce>()->vector == Point(6, 8));
  const auto& settlement = *loads[6].as<Settlement>();
  CHECK(settlement.support == 1);
  CHECK(settlement.slope == Point(6, 8));
  CHECK(settlement.rotation == 10);
  Load by_table{Pressure{.table = PressureTable("x,y,pressure\n0,0,1\n1,0,2\n0,1,3\n", "table.csv")}};
  scale(by_table, 2);
  CHECK(by_table.as<Pressure>()->at({1, 0}) == Approx(4));
}
