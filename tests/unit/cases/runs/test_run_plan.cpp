#include "cases/runs/run_plan.hpp"
#include "plate/model/problem.hpp"
#include "tests/catch.hpp"

namespace {

/// What a plan refers to.
struct Things {
  plate::Problem problem;
  plate::Analysis analysis;
  std::optional<fracture::Growth> growth;
  std::optional<post::SrifOptions> srif;
  std::map<std::string, geometry::Point> probes;

  cases::RunPlan plan() const {
    return {problem, analysis, growth, srif, probes, "", "", "", "", {}, {}, true, true, {}, true};
  }
};

}  // namespace

TEST_CASE("run plan: growth keeps a distance from the stable step, bonds that break a larger one") {
  Things things;
  things.analysis.duration = 3, things.analysis.safety = 0.7;
  const auto options = cases::grid_options(things.plan());
  CHECK(options.duration == 3);
  CHECK(options.safety == 0.7);
  CHECK(options.most == 1);
  things.growth.emplace();
  CHECK(cases::grid_options(things.plan()).most == 0.9);
  things.growth->criterion = fracture::Growth::Criterion::bond_energy;
  CHECK(cases::grid_options(things.plan()).most == 0.8);
}

TEST_CASE("run plan: growth at rest or in motion") {
  Things things;
  CHECK_FALSE(things.plan().grows_at_rest());
  things.growth.emplace();
  CHECK(things.plan().grows_at_rest());
  things.analysis.kind = plate::Analysis::Kind::dynamic;
  CHECK_FALSE(things.plan().grows_at_rest());
  CHECK(things.plan().moves());
}
