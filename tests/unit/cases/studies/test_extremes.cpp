#include "cases/studies/extremes.hpp"

#include "post/files/table.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/studies/extremes_table.hpp"

using extremes_table::row, extremes_table::w;

TEST_CASE("all problems of a table are told together") {
  const extremes_table::Table table(row("a", "") + row("a", "refused = \"x\"\nwarned = \"y\"") +
                                    row("b", "equal = { " + w + "row = \"c\", tolerance = 0 }"));
  try {
    table.read();
    FAIL("no error");
  } catch (const cases::CaseError& error) {
    std::vector<std::string> found;
    for (const auto& problem : error.problems()) found.push_back(problem.key + ": " + problem.what);
    CAPTURE(found);
    REQUIRE(found.size() == 5);
    for (const char* part : {"row[0]: has no oracle", "row[1]: cannot be refused", "row[1].title: \"a\" is given twice",
                             "row[2].equal.tolerance", "row[2].equal.row: no row \"c\" before"})
      CHECK(std::ranges::any_of(found, [&](const auto& text) { return text.starts_with(part); }));
  }
}

TEST_CASE("the tables in the tree read") {
  for (const char* table : {"extremes.toml", "galerkin.toml"}) {
    const auto extremes = cases::read_extremes(std::filesystem::path(PDPLATE_SOURCE_DIR) / "cases" / "extreme" / table);
    CHECK(extremes.rows.size() > 80);
  }
}
