#include "cases/studies/study_table.hpp"

#include "post/files/table.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using cases::StudyRow, small_run::TemporaryFolder;

namespace {

StudyRow compared(const std::string& label, double computed, double reference) {
  StudyRow result;
  result.labels = {label};
  result.quantity = "w";
  result.place = "centre";
  result.computed = computed;
  result.reference = reference;
  return result;
}

}  // namespace

TEST_CASE("study.csv is read back as it was written") {
  auto failed = compared("1", 0, 0);
  failed.computed.reset();
  failed.reference.reset();
  failed.message = "two\nlines, and a comma";
  const TemporaryFolder folder;
  post::write_csv(folder / "study.csv", table(cases::StudyTable{{"2a/W"}, {compared("0.1", 1.1, 1), failed}}));
  const auto table = post::read_csv(folder / "study.csv");
  CHECK(table.columns == std::vector<std::string>{"2a/W",
                                                  "quantity",
                                                  "place",
                                                  "srif_method",
                                                  "computed",
                                                  "reference",
                                                  "error",
                                                  "estimated_error",
                                                  "points",
                                                  "spacing",
                                                  "horizon",
                                                  "iterations",
                                                  "seconds",
                                                  "processor_seconds",
                                                  "solve_seconds",
                                                  "seconds_min",
                                                  "seconds_max",
                                                  "geometry_seconds",
                                                  "families_seconds",
                                                  "parameters_seconds",
                                                  "srif_seconds",
                                                  "output_seconds",
                                                  "reference_source",
                                                  "outcome",
                                                  "message"});
  REQUIRE(table.rows.size() == 2);
  CHECK(table.rows[0][0] == post::Cell("0.1"));
  CHECK(std::get<double>(table.rows[0][6]) == Approx(0.1));
  CHECK(table.rows[1][table.column("computed")] == post::Cell());
  CHECK(table.rows[1].back() == post::Cell(failed.message));
}

TEST_CASE("the text has a line for each row, columns under their titles, and errors in percent") {
  auto failed = compared("b", 0, 0);
  failed.computed.reset();
  failed.message = "one\ntwo";
  const auto text = to_text(cases::StudyTable{{"Länge"}, {compared("ä", 0.9975, 1), failed}});
  CHECK(std::ranges::count(text, '\n') == 3);
  CHECK_THAT(text, Catch::Contains("-0.250"));
  CHECK_THAT(text, Catch::Contains("one; two\n"));
  CHECK_THAT(text, Catch::StartsWith("Länge  quantity  place "));
  CHECK_THAT(text, Catch::Contains("\nä      w         centre "));
  CHECK_THAT(text, Catch::Contains("\nb      w         centre "));
  CHECK_THAT(to_text(compared("ä", 0.9975, 1)), Catch::Equals("ä: w at centre = 0.9975, error -0.250 %"));
}

TEST_CASE("an axis called spacing or horizon stands for the column of that name") {
  cases::StudyTable study{{"spacing"}, {compared("0.1", 1.1, 1)}};
  study.rows[0].spacing = study.rows[0].horizon = 0.1;
  const auto table = cases::table(study);
  CHECK(std::ranges::count(table.columns, "spacing") == 1);
  CHECK(table.rows[0][table.column("spacing")] == post::Cell("0.1"));
  CHECK(table.rows[0][table.column("horizon")] == post::Cell(0.1));
  CHECK(table.rows[0].size() == table.columns.size());
}

TEST_CASE("the text has a column of methods only where one is named") {
  cases::StudyTable study{{"E"}, {compared("0.1", 1.1, 1)}};
  CHECK_THAT(to_text(study), !Catch::Contains("method"));
  study.rows[0].method = "first";
  CHECK_THAT(to_text(study), Catch::Contains("method"));
}
