#include "plate/formulation/mechanisms.hpp"

#include "plate/bonds/ordinary_plate.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/problem.hpp"
#include "tests/catch.hpp"

using namespace plate;

TEST_CASE("rigid parts: a plate is one, a ligament one row of points wide parts it in two and itself") {
  Problem problem;
  problem.section = {1000, 0.3, 0.05, 5.0 / 6, 2};
  problem.loads = {Load{}};
  problem.discretization.spacing = 0.1;
  problem.discretization.formulation = &ordinary;
  problem.outline = geometry::rectangle(0, 0, 3, 1);
  const auto whole = discretise(problem).plate;
  const RigidParts one(whole->boundary(), whole->families());
  REQUIRE(one.count() == 1);
  CHECK(one.points(0) == 300);
  CHECK(!one.on_line(0));

  problem.outline.outer.vertices = {{0, 0}, {1, 0}, {1, 0.5}, {2, 0.5}, {2, 0}, {3, 0},
                                    {3, 1}, {2, 1}, {2, 0.6}, {1, 0.6}, {1, 1}, {0, 1}};
  problem.outline.outer.edge_names.clear();
  for (int i = 0; i < 12; ++i) problem.outline.outer.edge_names.push_back("edge" + std::to_string(i));
  const auto narrow = discretise(problem).plate;
  const RigidParts parts(narrow->boundary(), narrow->families());
  std::size_t large = 0, on_line = 0;
  for (std::uint32_t part = 0; part < parts.count(); ++part) large += parts.points(part) > 50;
  for (std::uint32_t k = 0; k < narrow->cloud().plate_points; ++k)
    if (parts.on_line(k)) {
      ++on_line;
      CHECK(std::abs(parts.line(k).x()) == 1);  // along the ligament
    }
  CHECK(large == 2);
  CHECK(on_line == 8);  // of ten, as the first and the last see past the corners
}
