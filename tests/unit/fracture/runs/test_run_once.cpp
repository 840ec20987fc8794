#include "fracture/runs/run_once.hpp"

#include "cases/driver/results.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/model/numerical_error.hpp"
#include "post/files/sinks/kept_sink.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

struct Once {
  cases::CaseFile file;
  fracture::Ready ready;
  post::Kept kept;

  explicit Once(const std::vector<std::string>& settings) : file(read(plain, settings)) {
    ready.plate = plate::discretise(file.content).plate;
  }
  post::Summary run() {
    fracture::Results results(cases::plan_of(file.content, {{}, true, &kept}), *ready.plate, ready.tip_methods,
                              {std::make_unique<post::KeptSink>(kept), "", ""});
    plate::Stopwatch stopwatch;
    return fracture::run_once(ready, results, stopwatch);
  }
  bool has(const std::string& name) const {
    return std::ranges::any_of(kept.tables, [&](const auto& table) { return table.first == name; });
  }
};

}  // namespace

TEST_CASE("run once: at rest, a row, a frame and the summary") {
  Once once({"discretization.spacing=0.1", "discretization.formulation=ordinary"});
  const auto summary = once.run();
  CHECK(summary.outcome == "done");
  CHECK(summary.points == 400);
  CHECK(once.has("history"));
  CHECK(once.has("reactions"));
  CHECK_FALSE(once.has("srif"));
  CHECK(once.kept.frames.size() == 1);
}

TEST_CASE("run once: what was good is kept where the numbers fail") {
  Once once({"discretization.spacing=0.1", "analysis.max_iterations=1", "analysis.preconditioner=diagonal"});
  CHECK_THROWS_AS(once.run(), plate::NumericalError);
  CHECK(once.has("history"));
  CHECK_THAT(once.kept.summary, Catch::Contains("\"outcome\": \"failed: "));
}

TEST_CASE("run once: frequencies, a frame for each") {
  Once once({"discretization.spacing=0.1", "analysis={kind=\"frequencies\",modes=2}", "section.density=1", "-load"});
  const auto summary = once.run();
  CHECK(summary.frequencies.size() == 2);
  CHECK(once.has("frequencies"));
  CHECK(once.kept.frames.size() == 2);
}
