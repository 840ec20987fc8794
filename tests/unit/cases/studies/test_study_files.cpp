#include "cases/studies/study_files.hpp"

#include "cases/studies/study_plots.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"
#include "tests/unit/post/study_of_powers.hpp"

TEST_CASE("study files: tables, orders where points are refined, plots and a page") {
  const small_run::TemporaryFolder folder;
  const auto study = study_of_powers::study();
  cases::write_study(study, {"powers", study.axes, false}, folder.path());
  for (const char* name : {"study.csv", "study.json", "orders.csv", "error_against_points.svg", "report.html"}) {
    INFO(name);
    CHECK(std::filesystem::exists(folder / name));
  }
  const auto text = cases::printed_study(study, "powers", folder.path());
  CHECK(text.starts_with("powers\n"));
  CHECK_THAT(text, Catch::Contains("fitted orders") && Catch::Contains("results in " + folder.path().string()));
}

TEST_CASE("study files: no orders of a single run") {
  const small_run::TemporaryFolder folder;
  cases::StudyTable study{{"h"}, {study_of_powers::row({"0.1"}, "w", 0.1, 1, 1)}};
  cases::write_study(study, {"one", study.axes, false}, folder.path());
  CHECK_FALSE(std::filesystem::exists(folder / "orders.csv"));
  CHECK_THAT(cases::printed_study(study, "one", folder.path()), !Catch::Contains("fitted orders"));
}
