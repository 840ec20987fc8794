#include "post/report/quantity.hpp"

#include "plate/solve/analysis.hpp"
#include "post/files/summary.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

TEST_CASE("read_summary: what was written is read, to the last digit") {
  post::Summary summary;
  summary.title = "t", summary.outcome = "done", summary.version = "0.1", summary.digest = "1e5";
  summary.points = 400, summary.bonds = 12;
  summary.formulation = "galerkin", summary.formulation_reason = "as the case says";
  summary.analysis.stop_reason = "6 modes";
  summary.analysis.kind = plate::Analysis::Kind::frequencies;
  summary.analysis.iterations = 17;
  summary.seconds = {{"solve", 0.1}, {"total", 1.0 / 3}};
  post::Srif srif;
  srif.tip = 2, srif.method = post::SrifMethod::series_fit, srif.K1 = 1.0 / 3, srif.K3 = -2e-17, srif.F1 = 0.1;
  srif.resolved = {true, false, true};
  srif.errors = {0.01, std::nullopt, 0.02};
  summary.srif = {srif};
  summary.peaks = {{"K1", 2, -0.7, 0.3, {}, {}}, {"w", std::nullopt, 5, 0.4, {}, {}}};
  summary.frequencies = {{1, 2.5, 15.7, 1e-5}};
  summary.growth = post::GrowthSummary{"no tip is left", 3, 0.5, 1.5, {}, {}, {}, {0.3, 0.4}};
  summary.warnings = {"set a", "set b"};
  const small_run::TemporaryFolder folder;
  std::ofstream(folder / "summary.json") << post::to_json(summary);
  const auto read = post::read_summary(folder / "summary.json");
  REQUIRE(read);
  CHECK(read->outcome == "done");
  CHECK(read->digest == "1e5");
  CHECK(read->points == 400);
  CHECK(read->bonds == 12);
  CHECK(read->formulation == "galerkin");
  CHECK(read->formulation_reason == "as the case says");
  CHECK(read->analysis.kind == summary.analysis.kind);
  CHECK(read->analysis.stop_reason == "6 modes");
  CHECK(read->analysis.iterations == 17);
  CHECK_FALSE(read->analysis.steps);
  CHECK(read->srif.size() == 1);
  CHECK(read->srif[0].method == srif.method);
  CHECK(read->srif[0].K1 == srif.K1);
  CHECK(read->srif[0].K3 == srif.K3);
  CHECK(read->srif[0].F1 == srif.F1);
  CHECK(read->srif[0].resolved == srif.resolved);
  CHECK(read->srif[0].errors == srif.errors);
  CHECK(read->peaks[1].value == 5);
  CHECK_FALSE(read->peaks[1].tip);
  CHECK(read->frequencies[0].frequency == 2.5);
  CHECK(read->growth->lengths == summary.growth->lengths);
  CHECK(read->warnings == summary.warnings);
  double total = 0;
  for (const auto& [stage, spent] : read->seconds)
    if (stage == "total") total = spent;
  CHECK(total == 1.0 / 3);
}

TEST_CASE("read_summary: what is not whole is nothing") {
  const small_run::TemporaryFolder folder;
  CHECK_FALSE(post::read_summary(folder / "none.json"));
  const auto text = post::to_json({});
  std::ofstream(folder / "half.json") << text.substr(0, text.size() / 2);
  CHECK_FALSE(post::read_summary(folder / "half.json"));
  auto elsewhere = text;
  elsewhere.replace(elsewhere.find("\"static\""), 8, "\"quasi-static\"");
  std::ofstream(folder / "elsewhere.json") << elsewhere;
  CHECK_FALSE(post::read_summary(folder / "elsewhere.json"));
  std::ofstream(folder / "other.json") << "{\"title\": 3}";
  CHECK_FALSE(post::read_summary(folder / "other.json"));
}
