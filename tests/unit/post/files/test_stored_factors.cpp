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
