// A motion by Lanczos vectors, through the program.
#include <nlohmann/json.hpp>

#include "cases/driver/run.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/post/small_run.hpp"

using case_text::expect;
using case_text::probed_motion;

TEST_CASE("Lanczos vectors: the motion of small steps, row by row") {
  const small_run::TemporaryFolder folder;
  const std::vector<std::string> shared{"output.history_every=0.01"};
  auto settings = shared;
  settings.push_back("analysis.method=central_difference");
  cases::run(case_text::read(probed_motion(), settings), {folder / "steps", true});
  settings.back() = "analysis.method=lanczos";
  const auto summary =
      cases::run(case_text::read(probed_motion("tolerance = 1e-5\n"), settings), {folder / "vectors", true});
  CHECK(summary.analysis.method == "lanczos");
  CHECK(*summary.analysis.steps == 40);
  CHECK(*summary.analysis.iterations < 200);  // measured 72
  CHECK_FALSE(summary.analysis.time_step);
  // steps have the mass of the points, vectors that of the cells: measured 1.2e-3, 1.2e-3, 7e-4
  for (const auto& [table, column, tolerance] : {std::tuple{"history.csv", "max_abs_w", 3e-3},
                                                 {"history.csv", "strain_energy", 3e-3},
                                                 {"probes.csv", "w", 3e-3}}) {
    const auto one = post::read_csv(folder / "steps" / table), other = post::read_csv(folder / "vectors" / table);
    REQUIRE(one.rows.size() == other.rows.size());
    const auto at = std::size_t(std::ranges::find(one.columns, column) - one.columns.begin());
    double largest = 0, difference = 0;
    for (std::size_t n = 0; n < one.rows.size(); ++n) {
      const double a = std::get<double>(one.rows[n][at]), b = std::get<double>(other.rows[n][at]);
      largest = std::max(largest, std::abs(a)), difference = std::max(difference, std::abs(a - b));
    }
    CAPTURE(table, column);
    CHECK(difference < tolerance * largest);
  }
}

TEST_CASE("Lanczos vectors: for graded points unless steps are asked for, what only one of both has is refused") {
  using enum cases::Analysis::Method;
  const auto method = [](const std::vector<std::string>& settings) {
    return case_text::read(probed_motion(), settings).content.analysis.method;
  };
  CHECK(method({}) == central_difference);
  CHECK(method({"discretization.tip_spacing=0.01"}) == lanczos);
  CHECK(method({"discretization.tip_spacing=0.01", "analysis.time_step=1e-5"}) == central_difference);
  CHECK(method({"discretization.tip_spacing=0.01", "analysis.method=central_difference"}) == central_difference);
  const auto refused = [](const std::string& key, std::vector<std::string> settings) {
    const auto found = case_text::problems(probed_motion(), settings);
    REQUIRE(found.size() == 1);
    CHECK(found[0].key == key);
  };
  refused("analysis.tolerance", {"analysis.tolerance=1e-4"});
  refused("analysis.time_step", {"analysis.method=lanczos", "analysis.time_step=1e-5"});
  refused("analysis.method", {"analysis.method=lanczos", "discretization.formulation=ordinary"});
  refused("analysis.safety", {"analysis.method=lanczos", "analysis.safety=0.5"});
  const auto resolved = cases::resolved_toml(case_text::read(probed_motion(), {"analysis.method=lanczos"}).content);
  CHECK_THAT(resolved, Catch::Contains("tolerance = 0.0003") && !Catch::Contains("safety"));
  CHECK(cases::resolved_toml(case_text::read(resolved).content) == resolved);
}

TEST_CASE("Lanczos vectors: what they leave out of the factors counts in the errors") {
  const std::vector<std::string> settings{"analysis.method=lanczos", "output.history_every=0.02",
                                          "discretization.spacing=0.025"};
  const auto largest_error = [&](const std::string& tolerance) {
    const small_run::TemporaryFolder folder;
    auto all = settings;
    all.push_back("analysis.tolerance=" + tolerance);
    cases::run(case_text::read(probed_motion(), all), {folder.path(), true});
    const auto table = post::read_csv(folder / "srif.csv");
    double result = 0;
    for (const auto& row : table.rows)
      if (const auto* error = std::get_if<double>(&row[table.column("estimated_error_K1")]))
        result = std::max(result, *error);
    return result;
  };
  CHECK(largest_error("1e-2") > 1.1 * largest_error("1e-5"));
}
