// Motions under loads in the plane and with large deflections: their tables, and what is the same after a checkpoint.
#include "cases/runs/membrane.hpp"

#include "cases/driver/prepared.hpp"
#include "cases/driver/run.hpp"
#include "cases/runs/checkpoints.hpp"
#include "cases/runs/outputs.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "post/files/sinks.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/post/small_run.hpp"

using namespace case_text;

namespace {

struct Moved {
  post::ResultsInMemory in_memory;
  post::Summary summary;
  bool went_on = false;

  const post::Table& table(const std::string& name) const {
    const auto found = std::ranges::find_if(in_memory.tables, [&](const auto& table) { return table.first == name; });
    REQUIRE(found != in_memory.tables.end());
    return found->second;
  }
};

/// A cracked plate, clamped on the left and moving in both ways.
cases::CaseFile moving(std::vector<std::string> settings) {
  settings.insert(settings.end(), {"section.density=1", "support[0].in_plane=\"fixed\"", "output.probes={a=[0.5,0.3]}",
                                   "load=[{kind='pressure',value=5,history='ramp',rise_time=0.1},{kind='edge_traction',"
                                   "edges=['right'],value=2,history='sine',frequency=3}]"});
  return read(plain + "[srif]\n", settings);
}

Moved moved(const cases::CaseFile& file, std::size_t steps, const std::filesystem::path& folder) {
  cases::Prepared ready(file);
  ready.steps->grid = {0.9 * ready.steps->limit, steps, 5};
  Moved result;
  plate::Stopwatch stopwatch;
  cases::Outputs outputs({ready.file.content, {{}, true, &result.in_memory}},
                         {std::make_unique<post::MemorySink>(result.in_memory), "", ""}, stopwatch);
  cases::RunCheckpoints checkpoints(post::Checkpoints(plate::single_process(), folder, "case"), 1e-9);
  std::vector<std::string> refused;
  result.went_on = checkpoints.find(refused);
  CHECK(refused.empty());
  result.summary = cases::run(ready, outputs, &checkpoints);
  return result;
}

}  // namespace

TEST_CASE("stretched motion: tables and summary have what happens in the plane, and go on from a checkpoint") {
  cases::CaseFile file;
  bool hit = false;
  SECTION("linear") {
    file = moving({"analysis={kind=\"dynamic\",duration=1}"});
  }
  SECTION("with large deflections and damping of the mass") {
    file = moving({"analysis={kind=\"dynamic\",duration=1,nonlinear=true,damping={mass=0.5}}"});
  }
  SECTION("with large deflections, from a deflection, under a mass that hits") {
    file = moving({"analysis={kind=\"dynamic\",duration=1,nonlinear=true}", "initial.deflection=\"0.05*(x+1)^2\"",
                   "impact={position=[0.5,0.5],mass=0.01,velocity=-1,stiffness=100}"});
    hit = true;
  }
  const small_run::TemporaryFolder alone, ended;
  const auto whole = moved(file, 30, alone.path());
  CHECK(whole.summary.outcome == "done");
  CHECK_FALSE(whole.went_on);
  REQUIRE(whole.summary.membrane);
  CHECK(whole.summary.membrane->largest_displacement > 0);
  CHECK(whole.table("probes").rows.size() == 7);
  CHECK(std::get<double>(whole.table("probes").rows.back()[whole.table("probes").column("u")]) != 0);
  CHECK(whole.table("srif").column("N1") < whole.table("srif").columns.size());
  CHECK(std::ranges::any_of(whole.in_memory.tables, [](const auto& table) { return table.first == "impact"; }) == hit);
  CHECK(whole.summary.reactions->largest_residual < 1e-9);

  moved(file, 17, ended.path());
  const auto gone_on = moved(file, 30, ended.path());
  CHECK(gone_on.went_on);
  REQUIRE(gone_on.in_memory.tables.size() == whole.in_memory.tables.size());
  for (std::size_t i = 0; i < whole.in_memory.tables.size(); ++i) {
    INFO(whole.in_memory.tables[i].first);
    CHECK((gone_on.in_memory.tables[i].second.rows == whole.in_memory.tables[i].second.rows));
  }
  REQUIRE(gone_on.summary.peaks.size() == whole.summary.peaks.size());
  for (std::size_t i = 0; i < whole.summary.peaks.size(); ++i)
    CHECK(gone_on.summary.peaks[i].value == whole.summary.peaks[i].value);
}

TEST_CASE("stretched motion: a plate that nothing holds in its plane flies off under a body force") {
  for (const std::string hub :
       {"", "support=[{ kind='hub', on={ circle=[0.4, 0.2, 0.2] } }]"}) {  // which keeps its mass
    CAPTURE(hub);
    std::vector<std::string> settings{"section.density=1", "analysis={kind=\"dynamic\",duration=0.5}",
                                      "output.probes={a=[0.5,0.3]}", "load=[{kind='body_force',vector=[3,-2]}]"};
    if (!hub.empty()) settings.insert(settings.end(), {hub, "geometry.cracks=[]"});
    const auto file = read(plain, settings);
    const small_run::TemporaryFolder folder;
    const auto summary = cases::run(file, {folder.path() / "run", true});
    CHECK(summary.outcome == "done");
    // u = f t^2 / (2 rho h) of every point
    REQUIRE(summary.membrane);
    // measured with the hub, whose points do not lie exactly at the radius of gyration: 3e-4, 5e-7
    CHECK(summary.membrane->largest_displacement ==
          Approx(std::hypot(3, 2) * 0.25 / (2 * 0.1)).epsilon(hub.empty() ? 1e-9 : 2e-3));
    CHECK(summary.membrane->strain_energy < (hub.empty() ? 1e-12 : 5e-6));
    CHECK(summary.analysis.method == "central_difference");
  }
}

TEST_CASE("large deflections: the work of all loads in the plane's summary has what heat across the plate puts in") {
  const auto file = read(plain, {"section.thermal_expansion=1e-3", "geometry.cracks=[]", "discretization.spacing=0.2",
                                 "analysis.nonlinear=true", "support[0].edges=['left','right','bottom','top']",
                                 "support[0].kind='simply_supported'", "support[0].in_plane='fixed'",
                                 "load=[{kind='temperature',value=30},{kind='pressure',value=1}]"});
  const small_run::TemporaryFolder folder;
  const auto summary = cases::run(file, {folder.path() / "run", true});
  const auto of = [&](const std::string& name) {
    return std::ranges::find(summary.energy, name, &std::pair<std::string, double>::first)->second;
  };
  CHECK(summary.membrane->external_work == of("external_work"));
  CHECK(of("strain") == Approx(of("external_work")).epsilon(0.02));
}

TEST_CASE("stretched motion: rotations beyond those of von Karman's strains are warned of") {
  CHECK(cases::warnings_about_rotations(0.29).empty());
  const auto warnings = cases::warnings_about_rotations(0.4);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings.front(), Catch::Contains("rotations reach 0.4"));
}

TEST_CASE("in the plane: factors that are small beside those of earlier times stay resolved") {
  const auto file = read(plain + "[srif]\n",
                         {"support[0].in_plane=\"fixed\"", "load=[{kind='edge_traction',edges=['right'],value=1}]"});
  const cases::Prepared ready(file);
  const auto state = plate::static_solution(*ready.membrane, file.content.analysis, {1e-8, 1000, {}}).solution.state;
  std::vector<double> largest;
  const cases::MembraneFactorsWanted wanted{file.content.srif, ready.membrane_methods, true, &largest};
  const auto load = ready.membrane->total_load();
  const auto first = cases::membrane_results(*ready.membrane, state, load, {}, wanted);
  REQUIRE(!largest.empty());
  const double before = largest[0];
  const plate::State small = 0.01 * state;
  const auto second = cases::membrane_results(*ready.membrane, small, 0.01 * load, {}, wanted);
  CHECK(largest[0] == before);
  for (std::size_t i = 0; i < first.factors.size(); ++i) {
    CHECK(second.factors[i].K1 == Approx(0.01 * first.factors[i].K1));
    if (first.factors[i].errors[0] && second.factors[i].errors[0]) CHECK(second.factors[i].resolved[0]);
  }
}
