// The direction of cracks that grow quasi-statically: smooth, and the same at tips that are alike.

#include "cases/driver/run.hpp"
#include "cases/input/case_file.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

namespace {

struct TipRow {
  double advance, tip, x, y, angle;
};

std::vector<TipRow> grown(const std::vector<std::string>& more) {
  std::vector<std::string> settings{"output.fields=[]", "discretization.spacing=0.025", "growth.max_advances=6"};
  settings.insert(settings.end(), more.begin(), more.end());
  const small_run::TemporaryFolder folder;
  cases::run(cases::read_case(PDPLATE_SOURCE_DIR "/cases/growth/inclined_crack.toml", settings), {folder.path(), true});
  const auto table = post::read_csv(folder / "tips.csv");
  const auto at = [&](const char* name) {
    return std::size_t(std::ranges::find(table.columns, name) - table.columns.begin());
  };
  std::vector<TipRow> result;
  for (const auto& row : table.rows) {
    const auto number = [&](const char* name) { return std::get<double>(row[at(name)]); };
    result.push_back({number("advance"), number("tip"), number("x"), number("y"), number("angle")});
  }
  return result;
}

}  // namespace

TEST_CASE("quasi-static growth: after its first turn a crack under bending goes on smoothly, and both tips alike") {
  const auto rows = grown({});
  REQUIRE(rows.size() >= 12);
  std::vector<double> directions;
  for (const auto& row : rows) {
    if (row.tip == 1 && row.advance > 0) directions.push_back(row.angle);
    for (const auto& other : rows)
      if (other.advance == row.advance && other.tip != row.tip)
        CHECK(std::hypot(row.x + other.x, row.y + other.y) < 0.05 * 0.025);  // measured 0.01 spacings
  }
  REQUIRE(directions.size() >= 5);
  CHECK(directions.front() < 26);  // from 45 degrees; measured 21.2
  for (std::size_t i = 1; i < directions.size(); ++i)
    CHECK(std::abs(directions[i] - directions[i - 1]) < 2);  // measured 1.6
}
