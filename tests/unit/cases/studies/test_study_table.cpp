#include "cases/studies/study_table.hpp"

#include "post/files/table.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/finished_run.hpp"

using finished_run::FinishedRun, post::Quantity, cases::StudyRow, small_run::TemporaryFolder;

namespace {

const std::vector<std::string> axes{"load", "2a/W"};

StudyRow labelled_row(const std::string& label, double computed, double reference) {
  StudyRow result;
  result.labels = {label};
  result.quantity = "w";
  result.place = "centre";
  result.computed = computed;
  result.reference = reference;
  return result;
}

}  // namespace

TEST_CASE("a reference matches where the labels that it names are those of the run") {
  const cases::Reference all{{"F1", 0}}, load{{"F1", 0}, {{"load", "bending"}}};
  const cases::Reference both{{"F1", 0}, {{"load", "bending"}, {"2a/W", "0.1"}}};
  CHECK(matches(all, axes, {"pressure", "0.1"}));
  CHECK(matches(load, axes, {"bending", "0.3"}));
  CHECK_FALSE(matches(load, axes, {"pressure", "0.3"}));
  CHECK(matches(both, axes, {"bending", "0.1"}));
  CHECK_FALSE(matches(both, axes, {"bending", "0.3"}));
  CHECK_FALSE(matches(both, axes, {"0.1", "bending"}));
}

TEST_CASE("two references overlap exactly where some run is matched by both") {
  std::vector<cases::Reference> references;
  for (const std::string load : {"", "pressure", "bending"})
    for (const std::string length : {"", "0.1", "0.3"})
      for (const std::size_t tip : {0, 1}) {
        cases::Reference reference{{"F1", tip}};
        if (!load.empty()) reference.where["load"] = load;
        if (!length.empty()) reference.where["2a/W"] = length;
        references.push_back(reference);
      }
  for (const auto& one : references)
    for (const auto& other : references) {
      bool expected = false;
      for (const std::string load : {"pressure", "bending"})
        for (const std::string length : {"0.1", "0.3"})
          expected = expected || (matches(one, axes, {load, length}) && matches(other, axes, {load, length}));
      CHECK(overlap(one, other) == (expected && one.quantity.tip == other.quantity.tip));
    }
}

TEST_CASE("a run wants each quantity once, with the reference that matches") {
  const std::vector<cases::Reference> references{{{"F1", 0}, {{"load", "bending"}}, 1.0},
                                                 {{"F1", 0}, {{"load", "pressure"}}, 2.0, "s"},
                                                 {{"K2", 1}, {}, 3.0},
                                                 {{"w", {}, "c"}, {{"load", "bending"}}, 4.0}};
  const auto has = [&](std::size_t i, bool) { return references[i].quantity.name != "K2"; };
  const auto found = cases::wanted({}, references, axes, {"pressure", "0.1"}, has);
  REQUIRE(found.size() == 2);
  CHECK(found[0].quantity.name == "F1");
  REQUIRE(found[0].reference);
  CHECK(std::get<double>(*found[0].reference) == 2);
  CHECK(found[0].source == "s");
  CHECK(found[1].quantity.name == "w");
  CHECK_FALSE(found[1].reference);
}

TEST_CASE("the first axis is outermost") {
  CHECK(cases::combinations({2, 3}) ==
        std::vector<std::vector<std::size_t>>{{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 1}, {1, 2}});
  CHECK(cases::combinations({}) == std::vector<std::vector<std::size_t>>{{}});
  CHECK(cases::combinations({2, 0}).empty());
}

TEST_CASE("names of folders are safe and differ") {
  CHECK(cases::folder_name({"pressure", "none, lattice constants", "0.1"}, {}) ==
        "pressure_none_lattice_constants_0.1");
  CHECK(cases::folder_name({"../../etc"}, {}).find_first_of("/") == std::string::npos);
  CHECK_FALSE(cases::folder_name({".."}, {}).starts_with('.'));
  CHECK(cases::folder_name({}, {}) == "run");
  CHECK(cases::folder_name({"a b"}, {"a_b", "a_b-2"}) == "a_b-3");
  for (const char* file : {"study.csv", "orders.csv", "error_against_points.svg", "study.csv.partial"})
    CHECK(cases::folder_name({file}, {}) != file);
  CHECK(cases::folder_name({std::string(1000, 'x')}, {}).size() < 200);
}

TEST_CASE("errors are relative to the reference, with its sign") {
  CHECK(labelled_row("a", 3, 2).error() == 0.5);
  CHECK(labelled_row("a", -3, -2).error() == 0.5);
  CHECK(labelled_row("a", 1, -2).error() == -1.5);
  CHECK_FALSE(labelled_row("a", 1, 0).error());
  auto unknown = labelled_row("a", 1, 2);
  unknown.reference.reset();
  CHECK_FALSE(unknown.error());
}

TEST_CASE("a finished run has a row for each quantity") {
  const FinishedRun run;
  StudyRow known;
  known.labels = {"a"};
  known.spacing = 0.1;
  const auto rows = cases::study_rows(known, {{{"K1", 0}, cases::Known(0.4), "a book"}, {{"K1", 5}, cases::Known(1.0)}},
                                      run.summary, run.folder.path());
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].source == "a book");
  CHECK(rows[0].labels == known.labels);
  CHECK(rows[0].place == "tip 0");
  CHECK(*rows[0].error() == Approx(0.25));
  CHECK(rows[0].points == std::size_t(400));
  CHECK(rows[0].iterations == std::size_t(17));
  CHECK(rows[0].seconds == 2.0);
  CHECK(rows[0].solve_seconds == 0.5);
  CHECK(rows[0].spacing == 0.1);
  CHECK(rows[0].message.empty());
  CHECK_FALSE(rows[1].computed);
  CHECK_FALSE(rows[1].message.empty());
  CHECK(cases::study_rows(known, {}, run.summary, run.folder.path()).size() == 1);
}

TEST_CASE("a method that a run lacks is said in its row, with those that it has") {
  const FinishedRun run;
  const auto rows = cases::study_rows(
      {}, {{{"K1", 0, {}, "series_fit"}, cases::Known(100.0)}, {{"K1", 0, {}, "third"}, cases::Known(1.0)}},
      run.summary, run.folder.path());
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].method == "series_fit");
  CHECK(*rows[0].error() == Approx(-0.01));
  CHECK_THAT(to_text(rows[0]), Catch::Contains("K1 at tip 0 by series_fit = 99"));
  CHECK_FALSE(rows[1].computed);
  CHECK_FALSE(rows[1].error());
  CHECK(rows[1].message == "tip 0 has no method third, but domain_integral, series_fit");
}

TEST_CASE("the error against a curve is the rms difference over the largest value of the curve") {
  const FinishedRun run;  // w of probe 7 is 1 at time 0 and 5 at time 1
  const cases::KnownCurve known{"some/curves.csv", "w", {{0, 0.5, 1}, {1.5, 3.5, -4}}};
  const auto rows = cases::study_rows(
      {}, {{{"w", {}, "7"}, known}, {{"w", {}, "7"}, cases::KnownCurve{"c.csv", "w", {{3, 4}, {1, 1}}}}}, run.summary,
      run.folder.path());
  REQUIRE(rows.size() == 2);
  CHECK(*rows[0].error() == Approx(std::sqrt((0.25 + 0.25 + 81) / 3) / 4));
  CHECK(rows[0].computed == 5.0);
  CHECK(rows[0].reference == -4.0);
  CHECK(rows[0].source == "curves.csv w");
  CHECK_FALSE(rows[1].error());
  CHECK_THAT(rows[1].message, Catch::Contains("0 samples in common"));
}

TEST_CASE("errors are relative to the reference or to a scale, estimated ones to the same") {
  const FinishedRun run;
  auto summary = run.summary;
  REQUIRE(summary.srif.front().tip == 0);
  summary.srif.front().errors[0] = 0.02;
  StudyRow known;
  known.labels = {"a"};
  const auto rows = cases::study_rows(
      known,
      {{{"K1", 0}, cases::Known(0.4), ""}, {{"K1", 0}, cases::Known(0.0), "", 2.0}, {{"K1", 0}, cases::Known(0.0), ""}},
      summary, run.folder.path());
  CHECK(*rows[0].error() == Approx(0.25));
  CHECK(*rows[0].estimated_error() == Approx(0.05));
  CHECK(*rows[1].error() == Approx(0.5 / 2));
  CHECK(*rows[1].estimated_error() == Approx(0.01));
  CHECK_FALSE(rows[2].error().has_value());
  CHECK_FALSE(rows[2].estimated_error().has_value());
}

TEST_CASE("study.csv is read back as it was written") {
  auto failed = labelled_row("1", 0, 0);
  failed.computed.reset();
  failed.reference.reset();
  failed.message = "two\nlines, and a comma";
  const TemporaryFolder folder;
  post::write_csv(folder / "study.csv", table(cases::StudyTable{{"2a/W"}, {labelled_row("0.1", 1.1, 1), failed}}));
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
  auto failed = labelled_row("b", 0, 0);
  failed.computed.reset();
  failed.message = "one\ntwo";
  const auto text = to_text(cases::StudyTable{{"Länge"}, {labelled_row("ä", 0.9975, 1), failed}});
  CHECK(std::ranges::count(text, '\n') == 3);
  CHECK_THAT(text, Catch::Contains("-0.250"));
  CHECK_THAT(text, Catch::Contains("one; two\n"));
  CHECK_THAT(text, Catch::StartsWith("Länge  quantity  place "));
  CHECK_THAT(text, Catch::Contains("\nä      w         centre "));
  CHECK_THAT(text, Catch::Contains("\nb      w         centre "));
  CHECK_THAT(to_text(labelled_row("ä", 0.9975, 1)), Catch::Equals("ä: w at centre = 0.9975, error -0.250 %"));
}

TEST_CASE("an axis called spacing or horizon stands for the column of that name") {
  cases::StudyTable study{{"spacing"}, {labelled_row("0.1", 1.1, 1)}};
  study.rows[0].spacing = study.rows[0].horizon = 0.1;
  const auto table = cases::table(study);
  CHECK(std::ranges::count(table.columns, "spacing") == 1);
  CHECK(table.rows[0][table.column("spacing")] == post::Cell("0.1"));
  CHECK(table.rows[0][table.column("horizon")] == post::Cell(0.1));
  CHECK(table.rows[0].size() == table.columns.size());
}

TEST_CASE("the text has a column of methods only where one is named") {
  cases::StudyTable study{{"E"}, {labelled_row("0.1", 1.1, 1)}};
  CHECK_THAT(to_text(study), !Catch::Contains("method"));
  study.rows[0].method = "first";
  CHECK_THAT(to_text(study), Catch::Contains("method"));
}
