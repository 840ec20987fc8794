#include "cases/studies/comparison.hpp"

#include <fstream>

#include "post/files/table.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using small_run::TemporaryFolder;

namespace {

/// The curves of a probe at these times.
void write_probes(const TemporaryFolder& folder, const std::vector<double>& times) {
  post::Table probes{{"time", "probe", "x", "y", "w"}, {}};
  for (const double t : times) probes.rows.push_back({t, "middle", 0.0, 0.0, 1 + t});
  post::write_csv(folder / "probes.csv", probes);
}

}  // namespace

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
    return cases::compared(folder / "run", folder / "reference.csv", {{{"max", within}}, {}});
  };
  CHECK(compared(0.11).above.empty());
  const auto run = compared(0.09);  // 10 % too large
  REQUIRE(run.above.size() == 1);
  CHECK_THAT(cases::to_text(run), Catch::Contains("max"));
  cases::write(run, {}, {});
  CHECK(folder.entries() == 2);
  cases::write(run, folder / "curves.svg", folder / "numbers.json");
  CHECK_THAT(small_run::text_of(folder / "curves.svg"), Catch::Contains("<svg"));
  cases::write(run, folder / "page.html", {});
  CHECK_THAT(small_run::text_of(folder / "page.html"), Catch::Contains("<html"));
  CHECK(folder.entries() == 5);
}

TEST_CASE("a run and a reference with nothing to compare: what is wrong is said") {
  const TemporaryFolder folder;
  post::write_csv(folder / "curve.csv", {{"t", "w"}, {{0.0, 1.0}, {1.0, 2.0}, {2.0, 3.0}}});
  post::write_csv(folder / "lengths.csv", {{"length", "w"}, {{0.0, 1.0}, {1.0, 2.0}}});
  post::write_csv(folder / "pressure.csv", {{"t", "pressure"}, {{0.0, 1.0}, {1.0, 2.0}}});
  const auto problem = [&](const std::string& reference) -> std::string {
    try {
      cases::compared(folder.path(), folder / reference, {});
    } catch (const std::exception& error) {
      return error.what();
    }
    return {};
  };
  write_probes(folder, {0});  // static
  CHECK_THAT(problem("curve.csv"), Catch::StartsWith("w: 1 samples in common"));
  CHECK_THAT(problem("lengths.csv"), Catch::StartsWith("no column t"));
  CHECK_THAT(problem("pressure.csv"), Catch::StartsWith("no curve in common"));
  CHECK_THAT(problem("nowhere.csv"), Catch::StartsWith("no such file"));
  std::ofstream(folder / "torn.csv") << "t,w\n1\n";
  CHECK_THAT(problem("torn.csv"), Catch::EndsWith("1 cells for 2 columns"));
  write_probes(folder, {0, 1, 2});
  CHECK(problem("curve.csv").empty());
}
