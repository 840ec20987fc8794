// Every case file of the tree reads and runs, coarse, through the program itself.
#include <algorithm>
#include <set>
#include <tuple>

#include "cases/studies/study.hpp"
#include "tests/cases/program.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"
#include "tests/unit/post/xml.hpp"

namespace fs = std::filesystem;
using program_run::Ended, program_run::program;
using small_run::TemporaryFolder;
using small_run::text_of;

namespace {

bool is_study(const fs::path& path) {
  return path.filename().string().starts_with("study_");
}

/// The TOML files below cases/static, cases/dynamic, cases/growth and cases/templates.
std::vector<fs::path> toml_files(bool studies) {
  std::vector<fs::path> files;
  for (const char* folder : {"static", "dynamic", "growth", "templates"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(PDPLATE_SOURCE_DIR) / "cases" / folder))
      if (entry.path().extension() == ".toml" && is_study(entry.path()) == studies) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

Ended run(const fs::path& file, const fs::path& folder, const std::vector<std::string>& settings) {
  std::vector<std::string> arguments{"run", file.string(), "--out", folder.string(), "--quiet", "--threads", "2"};
  for (const auto& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
  return program(arguments);
}

/// Overrides that make a case cheap: 30 cells across the smaller side at rest, 8 along a path by arc length, 40 else, a
/// fortieth of the duration; to a stated accuracy a coarse one and a quarter, because the first waves ask for the
/// finest points.
std::vector<std::string> coarse(const cases::Case& c) {
  const auto [low, high] = geometry::bounding_box(c.outline);
  using enum plate::AnalysisKind;
  const bool path = c.analysis.control == plate::LoadControl::arc_length;
  const double cells = path ? 8 : c.analysis.kind == static_ && !c.growth ? 30 : 40;
  std::vector<std::string> settings{"discretization.spacing=" + std::to_string((high - low).minCoeff() / cells)};
  if (c.analysis.kind == static_) settings.push_back("analysis.method=cg");
  if (c.analysis.kind == frequencies) settings.push_back("analysis.modes=2");
  const bool stated = c.srif && c.srif->accuracy;
  if (c.analysis.kind == dynamic)
    settings.push_back("analysis.duration=" + std::to_string(c.analysis.duration / (stated ? 4 : 40)));
  if (stated) settings.push_back("srif.accuracy=0.1");
  if (c.growth) settings.push_back("growth.max_advances=2");
  if (c.srif && c.srif->window)  // a length that suits the case's own spacing: here all of the crack behind the tip
    settings.insert(settings.end(), {"srif.window=" + std::to_string((high - low).maxCoeff()), "srif.skip=0"});
  return settings;
}

void check_files(const fs::path& folder, const cases::Case& c) {
  for (const char* name : {"summary.json", "case.resolved.toml", "fields.pvd", "fields_0000.vtu", "state.h5"}) {
    INFO(name);
    CHECK((fs::exists(folder / name) && fs::file_size(folder / name) > 0));
  }
  const bool frequencies = c.analysis.kind == cases::Analysis::Kind::frequencies;
  const bool swings = c.analysis.kind == cases::Analysis::Kind::harmonic;
  const bool buckles = c.analysis.kind == cases::Analysis::Kind::buckling;
  CHECK(fs::exists(folder / "history.csv") == !(frequencies || swings || buckles));
  CHECK(fs::exists(folder / "buckling.csv") == buckles);
  CHECK(fs::exists(folder / "response.csv") == swings);
  CHECK(fs::exists(folder / "impact.csv") == c.impact.has_value());
  CHECK(fs::exists(folder / "frequencies.csv") == frequencies);
  const bool is_static = c.analysis.kind == cases::Analysis::Kind::static_;
  CHECK(fs::exists(folder / "srif.csv") == ((c.srif && !swings) || (c.growth && is_static && !c.growth->by_bonds())));
  for (const char* name : {"growth.csv", "tips.csv", "cracks.csv", "cracks.pvd"})
    CHECK(fs::exists(folder / name) == c.growth.has_value());
  CHECK(fs::exists(folder / "cracks.vtp") == (c.growth || !c.cracks.empty()));
  CHECK(fs::exists(folder / "probes.csv") == (!c.output.probes.empty() && !swings));
  CHECK(text_of(folder / "summary.json").find("\"outcome\": \"done\"") != std::string::npos);
}

/// Every file for ParaView below the folder.
void check_xml(const fs::path& folder) {
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const auto kind = entry.path().extension();
    if (kind != ".vtu" && kind != ".vtp" && kind != ".pvd") continue;
    INFO(entry.path());
    CHECK(xml::error(text_of(entry.path())) == "");
    ++files;
  }
  CHECK(files >= 2);
}

fs::path central_crack() {
  return fs::path(PDPLATE_SOURCE_DIR) / "cases/static/central_crack_pressure.toml";
}

}  // namespace

TEST_CASE("every case reads and runs, and its resolved form gives the same case and results") {
  const auto files = toml_files(false);
  REQUIRE(files.size() >= 17);
  std::set<std::tuple<plate::AnalysisKind, bool, const plate::FormulationKind*>> run_again;
  for (const auto& file : files) {
    INFO(file);
    const auto content = cases::read_case(file, {}).content;
    const TemporaryFolder scratch;
    const auto ended = run(file, scratch / "first", coarse(content));
    INFO(ended.output);
    REQUIRE(ended.exit_code == 0);
    check_files(scratch / "first", content);
    check_xml(scratch / "first");

    const auto resolved = scratch / "first" / "case.resolved.toml";
    const bool stated = content.srif && content.srif->accuracy;  // a run begins anew to find its spacing
    if (!stated) CHECK(cases::resolved_toml(cases::read_case(resolved, {}).content) == text_of(resolved));
    const bool first =
        run_again.insert({content.analysis.kind, content.growth.has_value(), content.discretization.formulation})
            .second;
    if (!first && !stated) continue;  // the same case gives the same results: once of each kind
    const auto again = run(resolved, scratch / "again", {});
    INFO(again.output);
    REQUIRE(again.exit_code == 0);
    check_files(scratch / "again", content);
    CHECK(text_of(scratch / "again" / "case.resolved.toml") == text_of(scratch / "first" / "case.resolved.toml"));
    for (const char* table :
         {"srif.csv", "history.csv", "probes.csv", "frequencies.csv", "growth.csv", "tips.csv", "cracks.csv"})
      if (fs::exists(scratch / "first" / table))
        CHECK(text_of(scratch / "again" / table) == text_of(scratch / "first" / table));
  }
}

TEST_CASE("every study reads, with the cases of all its runs") {
  const auto files = toml_files(true);
  CHECK(files.size() >= 2);
  for (const auto& file : files) {
    INFO(file);
    const auto study = cases::read_study(file);
    CHECK(study.runs.size() > 1);
    CHECK_FALSE((study.references.empty() && study.quantities.empty()));
  }
}

TEST_CASE("every case passes the command that checks it") {
  for (const auto& file : toml_files(false)) {
    auto settings = coarse(cases::read_case(file, {}).content);
    std::vector<std::string> arguments{"check", file.string()};
    for (const auto& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
    const auto ended = program(arguments);
    INFO(file << ": " << ended.output);
    CHECK(ended.exit_code == 0);
  }
}

TEST_CASE("exit code 2: a wrong case, nothing is written") {
  const TemporaryFolder scratch;
  for (const char* wrong : {"section.poisson=0.7", "section.poissson=0.3", "geometry.cracks=[[[-0.3, 0], [1.7, 0]]]",
                            "support[0].edges=[\"north\"]", "discretization.spacing=\"small\"",
                            "support=[{kind=\"free\", edges=[\"top\"]}]"}) {
    const auto ended = run(central_crack(), scratch / "results", {"discretization.spacing=0.05", wrong});
    INFO(wrong << ": " << ended.output);
    CHECK(ended.exit_code == 2);
    CHECK_FALSE(ended.output.empty());
    CHECK_FALSE(fs::exists(scratch / "results"));
  }
  CHECK(run(scratch / "absent.toml", scratch / "results", {}).exit_code == 2);
  CHECK(program({"run"}).exit_code == 2);
  CHECK(program({"walk"}).exit_code == 2);
  CHECK(scratch.entries() == 0);
}

TEST_CASE("exit code 2: what loads in the plane cannot go with has one message") {
  struct Wrong {
    std::vector<std::string> settings;
    std::string message;
  };
  const std::string pulled = R"(load=[{kind="edge_traction", edges=["left", "right"], value=1.0}])";
  const std::vector<Wrong> all{{{pulled}, "support: the plate is not held in its plane"},
                               {{"analysis.nonlinear=true", R"(analysis.kind="frequencies")"},
                                "analysis.nonlinear: is used in statics and dynamics only"},
                               {{"analysis.nonlinear=true", R"(analysis.kind="buckling")", pulled},
                                "analysis.nonlinear: is used in statics and dynamics only"},
                               {{"cracks.contact=true", R"(analysis.kind="buckling")", pulled},
                                "cracks.contact: is used in statics and dynamics only"},
                               {{"cracks.contact=true", R"(discretization.boundary="surface_nodes")"},
                                "cracks.contact: the stiffness with surface nodes is not symmetric"},
                               {{"analysis.nonlinear=true", "growth={fracture_energy=1.0}"},
                                "growth: the loads at which cracks grow are found for linear plates"}};
  const TemporaryFolder scratch;
  for (const auto& [settings, message] : all) {
    std::vector<std::string> given{"discretization.spacing=0.05"};
    given.insert(given.end(), settings.begin(), settings.end());
    const auto ended = run(central_crack(), scratch / "results", given);
    INFO(message << ": " << ended.output);
    CHECK(ended.exit_code == 2);
    std::size_t told = 0;
    for (auto at = ended.output.find(message); at != std::string::npos; at = ended.output.find(message, at + 1)) ++told;
    CHECK(told == 1);
    CHECK_FALSE(fs::exists(scratch / "results"));
  }
}

TEST_CASE("exit code 3: not converged, the summary and the last frame are kept") {
  for (const char* method : {"adr", "cg"}) {
    const TemporaryFolder scratch;
    const auto ended =
        run(central_crack(), scratch / "results",
            {"discretization.spacing=0.05", "analysis.max_iterations=5", std::string("analysis.method=") + method});
    INFO(method << ": " << ended.output);
    CHECK(ended.exit_code == 3);
    CHECK(ended.output.find("not converged in 5 iterations") != std::string::npos);
    const auto summary = text_of(scratch / "results" / "summary.json");
    CHECK(summary.find("\"outcome\": \"failed") != std::string::npos);
    CHECK(summary.find("\"iterations\": 5") != std::string::npos);
    for (const char* name :
         {"case.resolved.toml", "history.csv", "srif.csv", "probes.csv", "fields.pvd", "fields_0000.vtu", "state.h5"})
      CHECK(fs::exists(scratch / "results" / name));
  }
}

TEST_CASE("exit code 2: commands that have no meaning for a growth, or for none") {
  const auto growth = fs::path(PDPLATE_SOURCE_DIR) / "cases/growth";
  const TemporaryFolder scratch;
  REQUIRE(
      run(growth / "double_torsion.toml", scratch / "rest", {"discretization.spacing=0.05", "growth.max_advances=2"})
          .exit_code == 0);
  REQUIRE(
      run(growth / "running_crack.toml", scratch / "motion", {"discretization.spacing=0.05", "analysis.duration=0.01"})
          .exit_code == 0);
  REQUIRE(run(central_crack(), scratch / "none", {"discretization.spacing=0.05"}).exit_code == 0);
  const auto fatigue = [&](const char* folder) {
    return program({"fatigue", (scratch / folder).string(), "--coefficient", "1", "--exponent", "2"}).exit_code;
  };
  CHECK(fatigue("rest") == 0);
  for (const char* coefficient : {"nan", "inf"})
    CHECK(
        program({"fatigue", (scratch / "rest").string(), "--coefficient", coefficient, "--exponent", "2"}).exit_code ==
        2);
  CHECK(program({"fatigue", (scratch / "rest").string(), "--coefficient", "1", "--exponent", "2", "--load", "nan"})
            .exit_code == 2);
  CHECK(program({"fatigue", (scratch / "rest").string(), "--coefficient", "1", "--exponent", "9999"}).exit_code == 3);
  CHECK(fatigue("motion") == 2);
  CHECK(fatigue("none") == 2);
  for (const char* folder : {"rest", "motion"}) {
    const auto ended = program({"srif", (scratch / folder).string()});
    INFO(ended.output);
    CHECK(ended.exit_code == 2);
    CHECK(ended.output.find("the cracks have grown since") != std::string::npos);
  }
}

TEST_CASE(
    "exit code 0: a growth that is not resolved says that it stopped, and fatigue repeats its doubts and says its "
    "units") {
  const auto ice = fs::path(PDPLATE_SOURCE_DIR) / "cases/static/ice_sheet.toml";
  const TemporaryFolder scratch;
  const auto ended =
      run(ice, scratch / "ice",
          {"section.thickness=0.3", "geometry.outline={rectangle=[0,0,20,20]}", "geometry.cracks=[[[10,0],[10,4]]]",
           "discretization.spacing=0.5", "discretization.tip_spacing=0.5", "foundation[0].modulus=1e4",
           "load[0].value=-397887", "load[0].on={circle=[9,3.5,0.2]}", "output.probes={edge=[9.9,0]}",
           "growth={fracture_energy=2,control=\"equilibrium\",max_length=8}"});
  INFO(ended.output);
  CHECK(ended.exit_code == 0);
  const auto summary = text_of(scratch / "ice" / "summary.json");
  CHECK(summary.find("\"outcome\": \"stopped: not resolved: the tip at (10, 4)") != std::string::npos);
  CHECK(summary.find("\"resolved\": false") != std::string::npos);
  const auto cycles =
      program({"fatigue", (scratch / "ice").string(), "--coefficient", "1e-30", "--exponent", "3"}).output;
  INFO(cycles);
  CHECK(cycles.find("warning: the growth stopped unresolved") != std::string::npos);
  CHECK(cycles.find("warning: load factors are uncertain") != std::string::npos);
  CHECK(cycles.find("units: length in m, K_range in Pa m^1/2") != std::string::npos);
}

TEST_CASE("exit code 3: numbers that no longer are, and a plate that does not move though it is loaded") {
  const auto moving = fs::path(PDPLATE_SOURCE_DIR) / "cases/dynamic/clamped_central_crack.toml";
  const TemporaryFolder scratch;
  const auto fails = [&](const fs::path& file, std::vector<std::string> settings, const std::string& why) {
    settings.push_back("discretization.spacing=0.1");
    const auto ended = run(file, scratch / "results", settings);
    INFO(settings.front() << ": " << ended.output);
    CHECK(ended.exit_code == 3);
    CHECK(ended.output.find(why) != std::string::npos);
    const auto summary = text_of(scratch / "results" / "summary.json");
    CHECK(summary.find("\"outcome\": \"failed") != std::string::npos);
    for (const char* table : {"history.csv", "srif.csv"})
      for (const char* number : {"nan", "inf"})
        CHECK(text_of(scratch / "results" / table).find(number) == std::string::npos);
  };
  fails(central_crack(), {"section.young=1e-306", "discretization.formulation=galerkin"}, "not finite");
  fails(central_crack(), {"load[0].value=1e-170"}, "nothing has moved although loads act");
  fails(moving, {"load[0].value=1e170", "load[0].history=[[0, 0], [0.01, 1]]"}, "double precision holds");
  CHECK(fs::exists(scratch / "results" / "fields_0000.vtu"));  // the last good one
  fails(moving, {"load[0].history=[[0, 0], [0.0100001, 0], [0.01000012, 1e6], [0.01000014, 0]]"},
        "no load acts at any step");
}

TEST_CASE("exit code 2, in motion a warning: a growing tip without room for its energy release rate") {
  const TemporaryFolder scratch;
  for (const char* cracks : {"geometry.cracks=[[[0, 0], [0.96, 0]]]", "geometry.cracks=[[[0, 0.9], [0.4, 0.9]]]"}) {
    std::vector<std::string> settings{"discretization.spacing=0.04", cracks,
                                      "growth={fracture_energy=1, control=\"equilibrium\", max_advances=2}"};
    const auto is_static = run(central_crack(), scratch / "results", settings);
    INFO(is_static.output);
    CHECK(is_static.exit_code == 2);
    CHECK(is_static.output.find("too little for an energy release rate") != std::string::npos);
  }
  CHECK(scratch.entries() == 0);
  const auto moving = fs::path(PDPLATE_SOURCE_DIR) / "cases/growth/hole_running_crack.toml";
  const auto in_motion = run(moving, scratch / "results", {"discretization.spacing=0.05", "analysis.duration=0.001"});
  CHECK(in_motion.exit_code == 0);
  CHECK(text_of(scratch / "results" / "summary.json").find("it stays where it is") != std::string::npos);
}

TEST_CASE("exit code 3: a growth whose numbers fail keeps what it has") {
  const auto file = fs::path(PDPLATE_SOURCE_DIR) / "cases/growth/double_torsion.toml";
  const TemporaryFolder scratch;
  const auto ended = run(file, scratch / "results", {"discretization.spacing=0.05", "analysis.max_iterations=3"});
  INFO(ended.output);
  CHECK(ended.exit_code == 3);
  CHECK(text_of(scratch / "results" / "summary.json").find("\"outcome\": \"failed") != std::string::npos);
  for (const char* name : {"case.resolved.toml", "history.csv", "growth.csv", "srif.csv"})
    CHECK(fs::exists(scratch / "results" / name));
}

TEST_CASE("exit codes of a frequency analysis: not converged, more modes than the plate has") {
  const auto file = fs::path(PDPLATE_SOURCE_DIR) / "cases/dynamic/frequencies_cantilever.toml";
  const TemporaryFolder scratch;
  const auto early = run(file, scratch / "early", {"discretization.spacing=0.25", "analysis.max_iterations=5"});
  INFO(early.output);
  CHECK(early.exit_code == 3);
  CHECK(early.output.find("not converged in 5 iterations") != std::string::npos);
  CHECK(text_of(scratch / "early" / "summary.json").find("\"outcome\": \"failed") != std::string::npos);
  const auto many = run(file, scratch / "many", {"discretization.spacing=0.25", "analysis.modes=100"});
  INFO(many.output);
  CHECK(many.exit_code == 2);
  CHECK_FALSE(fs::exists(scratch / "many"));
}

TEST_CASE("exit code 4: the folder cannot be made") {
  const TemporaryFolder scratch;
  std::ofstream(scratch / "file") << "in the way\n";
  const auto ended = run(central_crack(), scratch / "file" / "results", {"discretization.spacing=0.05"});
  INFO(ended.output);
  CHECK(ended.exit_code == 4);
  CHECK(text_of(scratch / "file") == "in the way\n");
}

TEST_CASE("exit code 0: help, version, keys") {
  for (const char* argument : {"--version", "--help", "keys"}) CHECK(program({argument}).exit_code == 0);
  CHECK(program({"--version"}).output.starts_with("pdplate "));
}
