#include "cases/studies/orders.hpp"

#include "cases/studies/ledger.hpp"
#include "post/files/table.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/study_of_powers.hpp"

using cases::refinement, cases::StudyTable, study_of_powers::row, study_of_powers::study;

TEST_CASE("a slope is that of the straight line, with the distances from it") {
  const auto exact = cases::slope({0, 1, 3}, {5, 3, -1});
  REQUIRE(exact);
  CHECK(exact->slope == Approx(-2));
  CHECK(exact->misfit == Approx(0).margin(1e-7));
  const auto bent = cases::slope({-1, 0, 1}, {1, 0, 1});
  REQUIRE(bent);
  CHECK(bent->slope == Approx(0).margin(1e-15));
  CHECK(bent->misfit == Approx(std::sqrt(2.0) / 3));  // distances 1/3, -2/3, 1/3
  CHECK_FALSE(cases::slope({1}, {2}));
  CHECK_FALSE(cases::slope({1, 1}, {2, 3}));
  CHECK_FALSE(cases::slope({}, {}));
}

TEST_CASE("the refinement is the axis along which the spacing changes, or else the horizon") {
  const auto along = refinement(study().rows);
  REQUIRE(along);
  CHECK(along->axis == 1);
  CHECK_FALSE(along->by_horizon);

  StudyTable ratios{{"load", "ratio"}, {}};
  for (const std::string load : {"a", "b"})
    for (const std::string ratio : {"3", "4"}) {
      ratios.rows.push_back(row({load, ratio}, "w", 0.1, 1, 1));
      ratios.rows.back().horizon = 0.1 * std::stod(ratio);
    }
  const auto by_horizon = refinement(ratios.rows);
  REQUIRE(by_horizon);
  CHECK(by_horizon->axis == 1);
  CHECK(by_horizon->by_horizon);

  for (auto& same : ratios.rows) same.horizon = 0.3 * (1 + 1e-12);
  CHECK_FALSE(refinement(ratios.rows));
  CHECK_FALSE(refinement({}));
  CHECK_FALSE(refinement({row({}, "w", 0.1, 1, 1)}));
}

TEST_CASE("lines run along an axis and keep quantities and methods apart") {
  auto table = study();
  table.rows[1].method = "other";
  const auto along = cases::lines(table.rows, 1);
  REQUIRE(along.size() == 5);
  CHECK(along[0].rows == std::vector<std::size_t>{0, 2, 4});
  CHECK(along[1].rows == std::vector<std::size_t>{1});
  CHECK(along[2].rows == std::vector<std::size_t>{3, 5});
  CHECK(along[2].first.method.empty());
  CHECK(cases::lines(table.rows, std::nullopt).size() == 12);
  table.rows[0].quantity.clear();  // a run that failed
  CHECK(cases::lines(table.rows, 1)[0].rows == std::vector<std::size_t>{1});
}

TEST_CASE("orders are the exponents of the errors") {
  const auto found = cases::orders(study());
  REQUIRE(found.size() == 4);
  const double expected[] = {2, 1.5, 1, 1.5};
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(found[i].runs == 3);
    CHECK(*found[i].order == Approx(expected[i]).epsilon(1e-9));
    CHECK(*found[i].misfit == Approx(0).margin(1e-7));
    CHECK(*found[i].seconds == Approx(-expected[i] / 3).epsilon(1e-9));  // seconds ~ spacing^-3
  }
  CHECK(found[2].line.labels[0] == "0.2");
}

TEST_CASE("rows without an error do not count, and one row is no line") {
  auto table = study();
  table.rows[0].computed.reset();
  table.rows[1].computed = table.rows[1].reference;  // an error of zero has no logarithm
  table.rows[3].reference.reset();
  const auto found = cases::orders(table);
  REQUIRE(found.size() == 3);  // of K1 at h = 0.1 a single row is left
  CHECK(found[0].runs == 2);
  CHECK_FALSE((found[0].order || found[0].misfit || found[0].seconds));  // two points lie on any line
  CHECK(*found[1].order == Approx(1));
}

TEST_CASE("the finest run of a line is the reference of the others and has no error") {
  auto table = study();
  for (auto& each : table.rows) {
    each.reference.reset();
    each.against_finest = each.quantity == "w";
  }
  table.rows[10].computed.reset();  // h = 0.2, spacing 0.025: the next takes its place
  cases::refer_to_finest(table);
  for (const std::size_t i : {0, 2}) {
    CHECK(table.rows[i].reference == table.rows[4].computed);
    CHECK(table.rows[i].source == "finest: 0.025");
    CHECK(table.rows[i].error());
  }
  CHECK_FALSE(table.rows[4].error());
  CHECK(table.rows[6].reference == table.rows[8].computed);
  CHECK_FALSE(table.rows[8].error());
  CHECK_FALSE(table.rows[1].reference);

  table.rows.push_back(row({"0.1", "0.0125"}, "w", 0.0125, 7, std::nullopt));
  table.rows.back().against_finest = true;
  cases::refer_to_finest(table);  // a finer run has come
  CHECK(table.rows[4].reference == 7.0);
  CHECK_FALSE(table.rows.back().reference);
}

TEST_CASE("of several runs with the least spacing the one with most points is the finest") {
  StudyTable table{{"spacing"}, {}};
  for (const char* label : {"a", "b", "c"}) table.rows.push_back(row({label}, "w", 0.1, 1, std::nullopt));
  table.rows[0].spacing = 0.2;
  table.rows[2].points = 1000000;
  for (auto& each : table.rows) each.against_finest = true;
  cases::refer_to_finest(table);
  CHECK(table.rows[1].source == "finest: c");
}

TEST_CASE("orders.csv has the axes but that of the refinement") {
  const auto table = cases::orders_table(study());
  CHECK(table.columns == std::vector<std::string>{"h", "quantity", "place", "srif_method", "against", "runs", "order",
                                                  "misfit", "seconds_slope"});
  REQUIRE(table.rows.size() == 4);
  CHECK(table.rows[2][0] == post::Cell("0.2"));
  CHECK(std::get<double>(table.rows[2][6]) == Approx(1));
  const auto text = cases::orders_text(study());
  CHECK(std::ranges::count(text, '\n') == 5);
  CHECK_THAT(text, Catch::StartsWith("h    quantity  place   against") && !Catch::Contains("srif_method"));
  CHECK(cases::orders_table({{"load"}, {}}).rows.empty());
}

TEST_CASE("where the finest run is missing, none of its line has a reference, and the other lines do") {
  auto table = study_of_powers::study();
  for (auto& each : table.rows) each.against_finest = each.quantity == "w";
  auto finest = table.rows[10];
  finest.outcome = cases::RunOutcome::missing, finest.quantity = finest.place = "", finest.computed.reset();
  table.rows.erase(table.rows.begin() + 10, table.rows.end());
  table.rows.push_back(finest);
  cases::refer_to_finest(table);
  for (const auto& row : table.rows) {
    if (row.quantity != "w") continue;
    CHECK(row.reference.has_value() == (row.labels == std::vector<std::string>{"0.1", "0.1"} ||
                                        row.labels == std::vector<std::string>{"0.1", "0.05"}));
    CHECK((row.source == "the finest is missing") == (row.labels[0] == "0.2"));
  }
}
