#include "post/files/factor_rows.hpp"

#include <limits>

#include "plate/model/errors.hpp"
#include "post/factors/srif.hpp"
#include "post/files/table.hpp"
#include "tests/catch.hpp"

using namespace post;

namespace {

Srif of_tip(std::size_t tip, double K1, SrifMethod method = SrifMethod::domain_integral) {
  Srif result;
  result.tip = tip, result.K1 = K1, result.method = method;
  result.errors = {0.01, 0.01, 0.01};
  result.estimated_error = 0.01 / K1;
  return result;
}

}  // namespace

TEST_CASE("factor rows: a row for every tip, method and time, in the columns that are stated") {
  FactorRows rows(0.1);
  rows.add({of_tip(0, 1), of_tip(0, 2, SrifMethod::series_fit), of_tip(1, 3)}, "then");
  rows.add({of_tip(0, 4), of_tip(0, 5, SrifMethod::series_fit), of_tip(1, 6)}, "later");
  const auto table = rows.table({0.5, 1});
  REQUIRE(table.rows.size() == 6);
  CHECK(table.columns == srif_columns());
  for (const auto& row : table.rows) CHECK(row.size() == table.columns.size());
  CHECK(table.rows[4][table.column("method")] == Cell("series_fit"));
  CHECK(table.rows[4][table.column("K1")] == Cell(5.0));
  CHECK(table.rows[5][table.column("time")] == Cell(1.0));
  CHECK(rows.last().size() == 3);
  REQUIRE(rows.largest().size() == 2);
  CHECK(rows.largest()[0] == 5);
  CHECK(rows.largest()[1] == 6);
}

TEST_CASE("factor rows: errors hold coarser points of the same method, and another formulation") {
  FactorRows rows(0.1);
  rows.compare_with(
      {{{of_tip(0, 0.5, SrifMethod::series_fit), of_tip(0, 0.9), of_tip(1, 7)}}, "galerkin", {{of_tip(0, 1.3)}}});
  rows.add({of_tip(0, 1)}, "then");
  CHECK(*rows.last()[0].errors[0] == Approx(0.3));
  CHECK(rows.last()[0].second->formulation == "galerkin");
  rows.add({of_tip(0, 1)}, "beyond what the other formulation has");
  CHECK(*rows.last()[0].errors[0] == Approx(0.1));
  CHECK_FALSE(rows.last()[0].second);
}

TEST_CASE("factor rows: coarser points of every row widen its own errors") {
  const OtherFactors others{{{of_tip(0, 0.7)}, {of_tip(0, 0.9)}}, {}, {}};
  std::vector<Srif> row{of_tip(0, 1)};
  others.widen_row(2, row, 0.1);
  CHECK(*row[0].errors[0] == 0.01);  // its own: there is no such row
  others.widen_row(0, row, 0.1);
  CHECK(*row[0].errors[0] == Approx(0.3));
}

TEST_CASE("factor rows: rows that are known stand for what is found, what motion leaves out is added in the end") {
  FactorRows rows(0.1);
  CHECK_FALSE(rows.known());
  rows.known({{of_tip(0, 2)}, {of_tip(0, 4)}});
  rows.truncated({0.05});
  rows.add({}, "then"), rows.add({}, "later");
  const auto table = rows.table({0, 1});
  REQUIRE(table.rows.size() == 2);
  for (const auto& row : table.rows)  // a share of 4, the largest
    CHECK(std::get<double>(row[table.column("estimated_error_K1")]) == Approx(0.21));
  REQUIRE(rows.warnings(0.01).size() == 1);
  CHECK_THAT(rows.warnings(0.01)[0],
             Catch::Contains("tip 0") && Catch::Contains("5 %") && Catch::Contains("`tolerance` = 0.001"));
}

TEST_CASE("factor rows: what is not finite is an error of the numbers that says when") {
  FactorRows rows(0.1);
  CHECK_THROWS_WITH(rows.add({of_tip(0, std::numeric_limits<double>::quiet_NaN())}, "at step 3"),
                    Catch::Contains("at step 3"));
  CHECK(rows.rows().empty());
}
