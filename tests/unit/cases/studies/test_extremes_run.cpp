#include "cases/studies/extremes.hpp"

#include "post/files/table.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/studies/extremes_table.hpp"

using extremes_table::row, extremes_table::w;

TEST_CASE("oracles that hold, and oracles that do not") {
  const extremes_table::Table table(
      row("plain", "value = { " + w + "is = 20, tolerance = 0.5, source = \"about\" }") +
      row("wrong value", "value = { " + w + "is = 1, tolerance = 0.5, source = \"no\" }") +
      row("twice as soft",
          "set = [\"section.young=500\"]\nequal = { " + w + "row = \"plain\", factor = 2, tolerance = 1e-9 }") +
      row("not equal", "set = [\"section.young=500\"]\nequal = { " + w + "row = \"plain\", tolerance = 1e-9 }") +
      row("cut off", "set = [\"geometry.cracks=[[[0, -1], [0, 1]]]\"]\nrefused = \"the piece of 200 points\"") +
      row("not cut off", "refused = \"the piece\"") +
      row("early", "set = [\"analysis.max_iterations=3\"]\nfailed = \"3 iterations\"") +
      row("thin", "set = [\"section.thickness=0.001\"]\nwarned = \"thickness 0.01 spacings\"") +
      row("not thin", "warned = \"thickness 0.\"") +
      row("not run", "set = [\"section.poisson=0.7\"]\nvalue = { " + w + "is = 1, tolerance = 0.5, source = \"no\" }"));
  const auto verdicts = table.run();
  REQUIRE(verdicts.size() == 10);
  for (const auto& verdict : verdicts) {
    CAPTURE(verdict.row, verdict.computed, verdict.expected, verdict.message);
    CHECK(verdict.holds == !(verdict.row.starts_with("not") || verdict.row.starts_with("wrong")));
  }
  CHECK(verdicts[9].computed == "refused");
  CHECK_THAT(verdicts[9].message, Catch::Contains("0.7 given"));
  const auto csv = post::read_csv(table.csv());
  REQUIRE(csv.rows.size() == 10);
  CHECK(csv.rows[1][csv.column("holds")] == post::Cell("no"));
  CHECK(std::filesystem::exists(table.csv().replace_filename("report.html")));
  CHECK_THAT(cases::to_text(verdicts), Catch::Contains("MISSED") && Catch::Contains("3 iterations"));
}

TEST_CASE("only some rows, with overrides that a row's own prevail over") {
  const extremes_table::Table table(
      row("plain",
          "set = [\"section.young=1000\"]\nvalue = { " + w + "is = 20, tolerance = 0.5, source = \"about\" }") +
      row("softer", "equal = { " + w + "row = \"plain\", factor = 2, tolerance = 1e-9 }") +
      row("third", "refused = \"x\""));
  const auto verdicts = table.run("softer", {"section.young=500"});
  REQUIRE(verdicts.size() == 2);  // and the row that it names
  CHECK(verdicts[0].row == "plain");
  CHECK(verdicts[1].holds);
  CHECK(table.run("fourth").empty());
}

TEST_CASE("the discrete energy is conserved up to the stable step, and a longer step refused") {
  const std::string moving =
      "\"analysis={kind=\\\"dynamic\\\", duration=1}\", \"section.density=1\", "
      "\"load[0].history=[[0, 1], [0.1, 1], [0.101, 0]]\"";
  const extremes_table::Table table(
      row("stable", "set = [" + moving +
                        "]\ntime_step_share = 0.99\n"
                        "conserved = { after = 0.102, tolerance = 1e-12 }") +
      row("loaded", "set = [" + moving +
                        "]\ntime_step_share = 0.99\n"
                        "conserved = { after = 0, tolerance = 1e-12 }") +
      row("above", "set = [" + moving + "]\ntime_step_share = 1.01\nrefused = \"stable limit\""));
  const auto verdicts = table.run();
  REQUIRE(verdicts.size() == 3);
  CAPTURE(verdicts[0].computed, verdicts[0].message);
  CHECK(verdicts[0].holds);  // measured: 2e-15
  CHECK_FALSE(verdicts[1].holds);
  CHECK(verdicts[2].holds);
}
