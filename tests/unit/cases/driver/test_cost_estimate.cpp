#include "cases/driver/cost_samples.hpp"

#include <fmt/format.h>

#include "cases/driver/run.hpp"
#include "plate/model/process.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/post/small_run.hpp"

namespace {

const std::string small_plate = case_text::plain + "[srif]\n";

}  // namespace

TEST_CASE("check foretells points, bonds, iterations and files of a run", "[foretell]") {
  for (const char* way : {"discretization.formulation=ordinary", "discretization.formulation=galerkin"}) {
    INFO(way);
    const auto file =
        case_text::read(small_plate, {"discretization.spacing=0.016", "analysis.preconditioner=diagonal", way});
    const auto told = cases::estimate_cost(file);
    const small_run::TemporaryFolder scratch;
    const auto found = cases::run(file, {scratch / "run", true});
    CHECK(told.sample_points < found.points / 2);
    CHECK(told.points == Approx(found.points).epsilon(0.02));
    CHECK(told.bonds == Approx(found.bonds).epsilon(0.03));
    CHECK(told.costs.iterations == Approx(double(*found.analysis.iterations)).epsilon(0.25));
    double files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(scratch / "run")) files += double(entry.file_size());
    CHECK(told.costs.files == Approx(files).epsilon(0.3));
    // times of a few tenths of a second on a shared machine: a wide band, tests/benchmarks/check_estimates has the
    // narrow one
    CHECK(told.costs.total() > 0.1 * found.seconds.back().second);
    CHECK(told.costs.total() < 10 * found.seconds.back().second);
  }
}

TEST_CASE("check tells how far linear theory is off as the run does, within a factor of 2", "[foretell]") {
  for (const char* way : {"ordinary", "galerkin"})
    for (const double pressure : {0.1, 0.3}) {
      INFO(way << ", pressure " << pressure);
      const auto file = case_text::read(
          small_plate,
          {"discretization.spacing=0.02", fmt::format("discretization.formulation={}", way),
           fmt::format("load[0].value={}", pressure),
           R"(support=[{kind="simply_supported", in_plane="fixed", edges=["left", "right", "top", "bottom"]}])"});
      const auto told = cases::estimate_cost(file);
      const small_run::TemporaryFolder scratch;
      const auto found = cases::run(file, {scratch / "run", true});
      REQUIRE(told.linear_theory_off);
      REQUIRE(found.linear_theory_off);
      CHECK(*found.linear_theory_off > 0.1);
      CHECK(*told.linear_theory_off > *found.linear_theory_off / 2);
      CHECK(*told.linear_theory_off < *found.linear_theory_off * 2);
      CHECK_THAT(cases::to_text(told, file.content), Catch::Contains("linear theory overstates deflections by about"));
    }
}

TEST_CASE("check tells the steps of a motion", "[foretell]") {
  const auto file =
      case_text::read(case_text::plain, {"discretization.spacing=0.025", "section.density=1",
                                         "analysis={kind=\"dynamic\", duration=0.02}", "output.history_every=0.01"});
  const auto told = cases::estimate_cost(file);
  const small_run::TemporaryFolder scratch;
  const auto found = cases::run(file, {scratch / "run", true});
  CHECK(told.time_limit == Approx(*found.analysis.time_step_limit).epsilon(0.02));
  CHECK(told.whole.steps == Approx(double(*found.analysis.steps)).epsilon(0.1));
}

TEST_CASE("check foretells a motion whose supports move from the first step on", "[foretell]") {
  const auto file = case_text::read(
      case_text::plain, {"discretization.spacing=0.1", "section.density=1", "analysis={kind=\"dynamic\", duration=0.3}",
                         "load=[{kind=\"settlement\", support=0, value=0.01, history=\"sine\", frequency=2}]"});
  CHECK(cases::estimate_cost(file).whole.steps > 1);
}

TEST_CASE("check foretells a motion under a wheel that has yet to enter", "[foretell]") {
  for (const char* load :
       {"load=[{kind=\"pressure\", value=1, on={circle=[-0.6,0.1,0.2]}, speed=1, path=[[-0.6,0.1],[0.7,0.1]]}]",
        "load=[{kind=\"point_force\", value=1, speed=9, "
        "path=[[-9,0.1],[-1,0.1],[-0.2,0.1],[10,0.3]]}]"}) {
    const auto file = case_text::read(case_text::plain, {"discretization.spacing=0.1", "section.density=1",
                                                         "analysis={kind=\"dynamic\", duration=0.3}", load});
    CHECK(cases::estimate_cost(file).whole.steps > 1);
  }
}

TEST_CASE("check refuses at once what the machine has no memory for", "[foretell]") {
  for (const char* spacing : {"2e-5", "4e-4"}) {
    const auto file =
        case_text::read(small_plate, {std::string("discretization.spacing=") + spacing, "analysis.method=direct"});
    CHECK_THROWS_AS(cases::cost(file), cases::CaseError);
  }
}

TEST_CASE("check takes finer samples where coarse ones cannot carry the case", "[foretell]") {
  const auto file = case_text::read(
      small_plate,
      {"discretization.spacing=0.01", "geometry.cracks=[[[-0.06, 0], [0.06, 0]]]", "discretization.refine_tips=false"});
  const auto told = cases::estimate_cost(file);
  CHECK(told.points == Approx(201 * 201).epsilon(0.02));
}

TEST_CASE("check names the other method of a motion where it is cheaper, and none that cannot be run", "[foretell]") {
  const auto told = [](const std::vector<std::string>& more, double seconds) {
    std::vector<std::string> all{"discretization.spacing=0.1", "section.density=1", "output.history_every=0.1",
                                 "analysis={kind=\"dynamic\", duration=1, damping={mass=0, stiffness=0.1}}"};
    all.insert(all.end(), more.begin(), more.end());
    return cases::cheaper_way(case_text::read(case_text::plain, all), seconds);
  };
  const std::string steps = "analysis.method=central_difference", dear = "analysis.method=lanczos";
  CHECK_THAT(told({steps}, 1e3), Catch::Contains("cheaper       analysis.method = \"lanczos\""));
  CHECK_THAT(told({steps, "discretization.formulation=ordinary"}, 1e3), Catch::Contains("formulation = \"galerkin\""));
  CHECK_THAT(told({dear, "analysis.damping={mass=1, stiffness=0}"}, 1e3), Catch::Contains("central_difference"));
  CHECK(told({steps}, 0.5).empty());  // not worth a word
  CHECK(told({steps, "support[0].kind=free"}, 1e3).empty());
  const std::string moved = "load[0]={kind=\"settlement\", support=0, value=0.01, history=\"sine\", frequency=2}";
  CHECK(told({steps, "-analysis.damping", moved}, 1e3).empty());
  CHECK(cases::cheaper_way(case_text::read(case_text::plain, {}), 1e3).empty());
}

TEST_CASE("check and run give settings in warnings their keys", "[foretell]") {
  const auto file = case_text::read(case_text::plain, {"discretization.spacing=0.1", "section.density=1",
                                                       "analysis={kind=\"dynamic\", duration=0.1, rotary_inertia=4}"});
  CHECK_THAT(cases::cost(file), Catch::Contains("; set analysis.rotary_inertia = 1\n"));
  const small_run::TemporaryFolder scratch;
  const auto found = cases::run(file, {scratch / "run", true});
  CHECK(std::ranges::any_of(found.warnings,
                            [](const auto& text) { return text.ends_with("; set analysis.rotary_inertia = 1"); }));
}
