#include "cases/runs/analyses.hpp"

#include <fmt/format.h>

#include "cases/driver/run.hpp"
#include "cases/runs/outputs.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "post/files/sinks.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

struct Once {
  cases::CaseFile file;
  cases::ValidatedPlate ready;
  post::ResultsInMemory in_memory;

  explicit Once(const std::vector<std::string>& settings) : file(read(plain, settings)) {
    ready.plate = plate::discretise(file.content).plate;
  }
  post::Summary run() {
    plate::Stopwatch stopwatch;
    cases::Outputs outputs({file.content, {{}, true, &in_memory}},
                           {std::make_unique<post::MemorySink>(in_memory), "", ""}, stopwatch);
    return cases::run(ready, outputs);
  }
  bool has(const std::string& name) const {
    return std::ranges::any_of(in_memory.tables, [&](const auto& table) { return table.first == name; });
  }
};

}  // namespace

TEST_CASE("analyses: at rest, a row, a frame and the summary") {
  Once once({"discretization.spacing=0.1", "discretization.formulation=ordinary"});
  const auto summary = once.run();
  CHECK(summary.outcome == "done");
  CHECK(summary.points == 400);
  CHECK(once.has("history"));
  CHECK(once.has("reactions"));
  CHECK_FALSE(once.has("srif"));
  CHECK(once.in_memory.frames.size() == 1);
}

TEST_CASE("analyses: what was good is kept where the numbers fail") {
  Once once({"discretization.spacing=0.1", "analysis.max_iterations=1", "analysis.preconditioner=diagonal"});
  CHECK_THROWS_AS(once.run(), plate::NumericalError);
  CHECK(once.has("history"));
  CHECK_THAT(once.in_memory.summary, Catch::Contains("\"outcome\": \"failed: "));
}

TEST_CASE("analyses: the last load step has the strain energy of the summary, with what heat stores") {
  const std::string hot = "{kind='temperature',mean=25,expression='60'", press = "{kind='pressure',value=2}";
  const auto loads =
      GENERATE_COPY("load=[" + hot + "}," + press + "]", "load=[" + hot + ",constant=true}," + press + "]", "-load");
  std::vector<std::string> settings{"section.thermal_expansion=2e-3",
                                    "discretization.spacing=0.2",
                                    "-geometry.cracks",
                                    "support[0].edges=['left','right','bottom','top']",
                                    "support[0].in_plane='fixed'",
                                    "analysis.nonlinear=true",
                                    loads};
  if (loads == "-load") settings.push_back("case=[{name='both',load=[" + hot + "}," + press + "]}]");
  const auto file = read(plain, settings);
  post::ResultsInMemory in_memory;
  const auto summary = cases::run(file, {{}, true, &in_memory});
  const auto& steps = summary.load_steps;
  const double last = std::get<double>(steps.rows.at(steps.rows.size() - 1).at(steps.column("strain_energy")));
  const double whole = loads == "-load" ? summary.load_cases.at(0).strain_energy : summary.energy.at(0).second;
  CAPTURE(loads, last / whole - 1);
  CHECK(last == Approx(whole).epsilon(1e-12));
}

TEST_CASE("analyses: frequencies, a frame for each") {
  Once once({"discretization.spacing=0.1", "analysis={kind=\"frequencies\",modes=2}", "section.density=1", "-load"});
  const auto summary = once.run();
  CHECK(summary.frequencies.size() == 2);
  CHECK(once.has("frequencies"));
  CHECK(once.in_memory.frames.size() == 2);
}

TEST_CASE("analyses: a motion whose energy grows without a load ends, and says where and by what step") {
  Once once({"discretization.spacing=0.1", "discretization.formulation=ordinary", "section.density=1",
             "analysis={kind=\"dynamic\",duration=1}", "load[0].history=[[0,1],[0.1,0]]"});
  const double limit = plate::stable_time_step(*once.ready.plate, once.ready.plate->constraints(),
                                               once.ready.plate->mass(once.file.content.analysis.rotary_inertia));
  const double step = GENERATE_COPY(0.9 * limit, 1.02 * limit);
  const std::size_t steps = 1000, per_row = GENERATE(10, 1000);  // also where the last row alone shows it
  once.ready.steps = {limit, {step, steps, per_row}};
  if (step < limit) {
    CHECK(once.run().outcome == "done");
    return;
  }
  CHECK_THROWS_WITH(once.run(), Catch::Contains("the numbers are wrong") && Catch::Contains("the time step") &&
                                    Catch::Contains("1.02 of the stable one"));
  CHECK(once.has("history"));
  CHECK_THAT(once.in_memory.summary, Catch::Contains("\"outcome\": \"failed: the plate has an energy of"));
}

TEST_CASE("analyses: what is not finite is named with point, place and time") {
  const Once once({"discretization.spacing=0.1"});
  const plate::NumericalError at("w of point 3 is not finite at step 5, time 0.1", 3);
  post::Summary summary;
  const auto place = once.ready.plate->cloud().positions[3];
  CHECK(std::string(cases::placed(at, *once.ready.plate, summary).what()) ==
        fmt::format("w of point 3 is not finite at step 5, time 0.1; the point is at ({:g}, {:g})", place.x(),
                    place.y()));
  summary.analysis.time_step = 1, summary.analysis.time_step_limit = 2;
  CHECK_THAT(cases::placed(plate::NumericalError("no"), *once.ready.plate, summary).what(),
             Catch::Equals("no; the time step 1 is 0.5 of the stable one"));
}
