#include "plate/galerkin/discretised_cells.hpp"

#include "plate/galerkin/galerkin_plate.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"

using namespace plate;

TEST_CASE("cut share: faces of a crack parted from each other, all of a place together") {
  const auto cells = galerkin_plate::cells(geometry::rectangle(0, 0, 1.2, 0.8), 0.1, {{{0.3, 0.4}, {0.8, 0.4}}});
  const auto areas = areas_of(cells);
  CHECK(areas == galerkin_plate::families(cells).areas);
  const auto cut = cut_share(cells, areas);
  std::size_t faces = 0;
  for (std::size_t k = 0; k < cut.size(); ++k) {
    const auto& x = cells.positions[k];
    const bool inside = std::abs(x.y() - 0.4) < 1e-9 && x.x() > 0.35 && x.x() < 0.75;
    CHECK(cut[k] == Approx(inside ? 0.5 : 0).margin(1e-12));
    faces += inside;
  }
  CHECK(faces == 8);
}

TEST_CASE("cells with wider spacings: about a quarter of the points") {
  Problem problem;
  problem.outline = galerkin_plate::with_hole();
  problem.section = galerkin_plate::section;
  problem.discretization.spacing = 0.02, problem.discretization.formulation = &galerkin;
  const auto fine = cells_of(problem, {}, 1), coarse = cells_of(problem, {}, 2);
  CHECK(coarse.units.spacing == Approx(0.04));
  CHECK(double(fine.positions.size()) / double(coarse.positions.size()) == Approx(4).epsilon(0.15));
}

TEST_CASE("laid out by one process: all points are there, and none has a number of its own") {
  Problem problem;
  problem.outline = geometry::rectangle(0, 0, 1, 1);
  problem.section = galerkin_plate::section;
  problem.discretization.spacing = 0.1, problem.discretization.formulation = &galerkin;
  problem.loads = {Load{Pressure{.value = 3}}};
  Stopwatch stopwatch;
  const auto found = discretised_part(problem, {}, cells_of(problem, {}, 1), single_process(), stopwatch);
  CHECK(found.cells.positions.size() == 121);
  CHECK(found.number.empty());
  CHECK(found.layout.boundary.map.owned.empty());
  CHECK(found.layout.loads[0].forces.row(0).sum() == Approx(3));
  CHECK(found.layout.pieces.front().free_modes == 3);
}
