#include <limits>
#include <numbers>

#include "post/files/atomic_file.hpp"
#include "post/files/table.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using post::Cell, post::Table, small_run::TemporaryFolder, small_run::text_of;

namespace {

Table table_of(const std::string& text) {
  const TemporaryFolder folder;
  post::write_atomically(folder / "t.csv", text);
  return post::read_csv(folder / "t.csv");
}

}  // namespace

TEST_CASE("a table comes back from CSV as it was") {
  const TemporaryFolder folder;
  constexpr double tiny = std::numeric_limits<double>::denorm_min(), huge = std::numeric_limits<double>::max();
  const Table table{{"time", "method", "F1, normalized", "word"},
                    {{0.1, "displacement_extrapolation", std::numbers::pi, ""},
                     {1.0 / 3, "a, b", Cell(), "1e5"},
                     {-0.0, "say \"so\"", tiny, " nan"},
                     {huge, "two\nlines", -1e-300, "# no comment"}}};
  post::write_csv(folder / "t.csv", table);
  const Table again = post::read_csv(folder / "t.csv");
  CHECK(again.columns == table.columns);
  REQUIRE(again.rows.size() == table.rows.size());
  for (std::size_t i = 0; i < table.rows.size(); ++i) CHECK((again.rows[i] == table.rows[i]));
}

TEST_CASE("CSV is written with the shortest numbers that read back") {
  const TemporaryFolder folder;
  post::write_csv(folder / "t.csv", {{"a", "b", "c"}, {{0.1, Cell(), "word"}, {3.0, 1e-20, Cell()}}});
  CHECK(text_of(folder / "t.csv") == "a,b,c\n0.1,,word\n3,1e-20,\n");
}

TEST_CASE("CSV has no negative zero") {
  CHECK(post::csv_text({{"a", "b"}, {{-0.0, -1.0}}}) == "a,b\n0,-1\n");
}

TEST_CASE("comments, blank lines, spaces and Windows line ends are read") {
  const Table table = table_of("# made by hand\r\nt, w\r\n# zero\r\n0, +1\r\n\r\n1,-2");
  CHECK(table.columns == std::vector<std::string>{"t", "w"});
  REQUIRE(table.rows.size() == 2);
  CHECK((table.rows[0] == std::vector<Cell>{0.0, 1.0}));
  CHECK((table.rows[1] == std::vector<Cell>{1.0, -2.0}));
}

TEST_CASE("numbers that are not finite stay numbers") {
  const Table table = table_of("a,b\nnan,-inf\n");
  CHECK(std::isnan(std::get<double>(table.rows[0][0])));
  CHECK(std::get<double>(table.rows[0][1]) == -std::numeric_limits<double>::infinity());
}

TEST_CASE("what is wrong with a table is said with file and line") {
  CHECK_THROWS_WITH(table_of("# c\na,b\n1,2\n\n1,2,3\n"), Catch::Contains("t.csv:5: 3 cells for 2 columns"));
  CHECK_THROWS_WITH(table_of("a,a\n"), Catch::Contains("t.csv:1: column a appears twice"));
  CHECK_THROWS_WITH(table_of("a,,b\n"), Catch::Contains("t.csv:1: column 2 has no name"));
  CHECK_THROWS_WITH(table_of("a\n\"x\ny"), Catch::Contains("t.csv:2: a quotation mark is not closed"));
  CHECK_THROWS_WITH(table_of("a,b\n\"x\"y,1\n"), Catch::Contains("t.csv:2: text behind a closing quotation mark"));
  CHECK_THROWS_WITH(table_of("# nothing else\n"), Catch::Contains("no header line"));
  CHECK_THROWS_WITH(post::read_csv("not/there.csv"), Catch::Contains("not/there.csv"));
}

TEST_CASE("a row that does not fit is not written") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(post::write_csv(folder / "t.csv", {{"a", "b"}, {{1.0}}}), std::invalid_argument);
  CHECK(folder.entries() == 0);
}

TEST_CASE("an unknown column is named with those that exist") {
  const Table table{{"time", "w"}, {}};
  CHECK(table.column("w") == 1);
  CHECK_THROWS_WITH(table.column("v"), "no column v; there are time, w");
}
