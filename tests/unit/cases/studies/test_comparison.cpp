#include "cases/studies/comparison.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "cases/input/case_file.hpp"
#include "post/files/table.hpp"
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

TEST_CASE("a run and a reference with nothing to compare are wrong arguments, not a failed machine") {
  const TemporaryFolder folder;
  post::write_csv(folder / "curve.csv", {{"t", "w"}, {{0.0, 1.0}, {1.0, 2.0}, {2.0, 3.0}}});
  post::write_csv(folder / "lengths.csv", {{"length", "w"}, {{0.0, 1.0}, {1.0, 2.0}}});
  post::write_csv(folder / "pressure.csv", {{"t", "pressure"}, {{0.0, 1.0}, {1.0, 2.0}}});
  const auto problem = [&](const std::string& reference) -> std::string {
    try {
      cases::compare({folder.path(), folder / reference, {}, {}, {}, {}});
    } catch (const cases::CaseError& error) {
      REQUIRE(error.problems().size() == 1);
      CHECK_THAT(error.problems()[0].place, Catch::EndsWith(reference));
      return error.problems()[0].what;
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
