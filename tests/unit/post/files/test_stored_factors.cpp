#include "post/files/factor_rows.hpp"

#include "plate/formulation/discretised.hpp"
#include "plate/solve/statics.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/files/hdf5/state_file.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("stored factors: found again in the states of a run, and of no other plate") {
  const auto c = read(plain + "[srif]\n", {"discretization.spacing=0.05"}).content;
  const auto plate = plate::discretise(c).plate;
  const auto methods = post::tip_methods(*plate, *c.srif);
  const auto state = plate::static_solution(*plate, c.analysis, {1e-8, 10000, {}}).solution.state;
  const auto expected = post::srifs(*plate, *c.srif, methods, state);
  const plate::State stored = state.leftCols(Eigen::Index(plate->points()));
  post::StoredRun run{std::vector<Eigen::Vector2d>(plate->points()), {0.5, 1}, {stored, 2 * stored}};
  const auto table = post::stored_factors(run, *plate, *c.srif, methods);
  REQUIRE(table.rows.size() == 2 * expected.size());
  const auto K1 = table.column("K1");
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(std::get<double>(table.rows[i][K1]) == Approx(expected[i].K1));
    CHECK(std::get<double>(table.rows[expected.size() + i][K1]) == Approx(2 * expected[i].K1));
  }
  run.positions.pop_back();
  CHECK_THROWS_WITH(post::stored_factors(run, *plate, *c.srif, methods), Catch::Contains("does not belong"));
}

TEST_CASE("stored factors: N1 and N2 of a plate in its plane, found again in its displacements") {
  const auto c = read(plain + "[srif]\n", {"discretization.spacing=0.05", "support[0].in_plane=\"fixed\"",
                                           "load=[{kind='pressure',value=1},{kind='edge_traction',edges=['right'],"
                                           "tensor=[1,2,0.5]}]"})
                     .content;
  const auto found = plate::discretise(c);
  const auto &plate = *found.plate, &membrane = *found.membrane;
  const auto methods = post::tip_methods(plate, *c.srif), in_plane = post::tip_methods(membrane, *c.srif);
  const auto solved = [&](const plate::Formulation& one) {
    return plate::static_solution(one, c.analysis, {1e-8, 10000, {}}).solution.state;
  };
  const auto bent = solved(plate), stretched = solved(membrane);
  auto expected = post::srifs(plate, *c.srif, methods, bent);
  post::add_membrane(expected, post::srifs(membrane, *c.srif, in_plane, stretched), c.section);
  const auto points = Eigen::Index(plate.points());
  post::StoredRun run{std::vector<Eigen::Vector2d>(plate.points()), {0}, {bent.leftCols(points)}};
  const auto again = [&] {
    return post::stored_factors(run, plate, *c.srif, methods, post::PlateInPlane{membrane, in_plane});
  };
  CHECK_THROWS_WITH(again(), Catch::Contains("no displacements in the plane"));
  auto& displacement = run.displacements.emplace_back(2, points);
  displacement << stretched.row(2).head(points), -stretched.row(1).head(points);
  const auto table = again();
  REQUIRE(table.rows.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(table.rows[i].size() == table.columns.size());
    if (const auto& srif = expected[i]; srif.membrane && srif.membrane->resolved[0])
      CHECK(std::get<double>(table.rows[i][table.column("N1")]) == Approx(srif.membrane->N[0]));
  }
  CHECK(expected[0].membrane->N[0] != 0);
}
