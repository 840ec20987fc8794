#include "post/files/recorder.hpp"

#include "cases/driver/prepared.hpp"
#include "plate/formulation/formulation.hpp"
#include "post/files/sinks.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("points without cells are those of the cells that are drawn") {
  for (const char* formulation : {"ordinary", "galerkin"}) {
    INFO(formulation);
    const auto plate =
        cases::discretised(read(plain, {std::string("discretization.formulation=") + formulation})).plate;
    const auto points = post::points_of(*plate), drawn = plate->mesh();
    CHECK(points.positions == drawn.positions);
    CHECK(points.areas == drawn.areas);
    CHECK(points.cut == drawn.cut);
    CHECK(points.spacing == drawn.spacing);
    CHECK(points.thickness == drawn.thickness);
    CHECK(points.quads.size() + points.triangles.size() + points.corners.size() == 0);
    CHECK(drawn.quads.size() + drawn.triangles.size() > 0);
  }
}

TEST_CASE("messages of a summary name settings as they are told to") {
  post::ResultsInMemory kept;
  post::Recorder recorder(std::make_unique<post::MemorySink>(kept), "", "");
  recorder.name_settings([](std::string_view message) { return "<" + std::string(message) + ">"; });
  post::Summary summary;
  summary.outcome = "a", summary.analysis.stop_reason = "b", summary.warnings = {"c", "d"};
  summary.growth.emplace().outcome = "e", summary.accuracy.emplace().outcome = "f";
  plate::Stopwatch stopwatch;
  const auto found = recorder.finish(summary, stopwatch);
  CHECK(found.outcome == "<a>");
  CHECK(found.analysis.stop_reason == "<b>");
  CHECK(found.warnings == std::vector<std::string>{"<c>", "<d>"});
  CHECK(found.growth->outcome == "<e>");
  CHECK(found.accuracy->outcome == "<f>");
  CHECK_THAT(kept.summary, Catch::Contains("\"<c>\""));
}
