#include "cases/templates/new_case.hpp"

#include "cases/studies/study.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/post/small_run.hpp"

TEST_CASE("new: every template is on the menu, written as it stands in the tree, and never over a file") {
  const auto menu = cases::template_menu();
  REQUIRE(cases::templates().size() >= 8);
  for (const auto& [file, content] : cases::templates()) {
    const small_run::TemporaryFolder scratch;
    const auto name = file.substr(0, file.size() - 5), path = (scratch / "new.toml").string();
    CHECK_THAT(menu, Catch::Contains(name + " "));
    CHECK_THAT(cases::new_case(name, path), Catch::Contains(path));
    CHECK(small_run::text_of(path) == content);
    CHECK(small_run::text_of(std::string(PDPLATE_SOURCE_DIR) + "/cases/templates/" + file) == content);
    CHECK_THROWS_WITH(cases::new_case(name, path), Catch::Contains("not overwritten"));
  }
  CHECK_THROWS_WITH(cases::new_case("frist", "x.toml"), Catch::Contains("did you mean"));
}

TEST_CASE("new: a study comes with its case, which is never written over") {
  const small_run::TemporaryFolder scratch;
  const auto path = (scratch / "mine.toml").string();
  CHECK_THAT(cases::new_case("study_spacing", path),
             Catch::Contains("first.toml written") && Catch::Contains("pdplate study"));
  CHECK(cases::read_study(path).runs.size() == 4);
  std::ofstream(scratch / "first.toml") << "# mine";
  CHECK_THAT(cases::new_case("study_spacing", (scratch / "again.toml").string()), Catch::Contains("first.toml exists"));
  CHECK(small_run::text_of(scratch / "first.toml") == "# mine");
  CHECK_THAT(cases::new_case("first", (scratch / "alone.toml").string()), Catch::Contains("pdplate run"));
}
