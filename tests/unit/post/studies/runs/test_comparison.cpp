#include "post/studies/runs/comparison.hpp"

#include <catch2/catch.hpp>

#include "post/files/table.hpp"
#include "tests/unit/post/small_run.hpp"

using small_run::TemporaryFolder;

TEST_CASE("comparison: what is above its tolerance is said, and files are written where they have a name") {
  const TemporaryFolder folder;
  post::Table probes{{"time", "probe", "x", "y", "w"}, {}}, reference{{"t", "w"}, {}};
  for (const double t : {0.0, 1.0, 2.0, 3.0}) {
    probes.rows.push_back({t, "tip", 0.1, 0.0, 1.1 * t});
    reference.rows.push_back({t, t});
  }
  std::filesystem::create_directory(folder / "run");
  post::write_csv(folder / "run/probes.csv", probes);
  post::write_csv(folder / "reference.csv", reference);
  const auto compared = [&](double within) {
    return post::compared(folder / "run", folder / "reference.csv", {{{"max", within}}, {}});
  };
  CHECK(compared(0.11).above.empty());
  const auto run = compared(0.09);  // 10 % too large
  REQUIRE(run.above.size() == 1);
  CHECK_THAT(post::to_text(run), Catch::Contains("max"));
  post::write(run, {}, {});
  CHECK(folder.entries() == 2);
  post::write(run, folder / "curves.svg", folder / "numbers.json");
  CHECK_THAT(small_run::text_of(folder / "curves.svg"), Catch::Contains("<svg"));
  post::write(run, folder / "page.html", {});
  CHECK_THAT(small_run::text_of(folder / "page.html"), Catch::Contains("<html"));
  CHECK(folder.entries() == 5);
}
