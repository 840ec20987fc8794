// The folder that a run writes to: what an earlier run left goes, what is not of a run is not touched.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cases/driver/run.hpp"
#include "post/files/hdf5/state_file.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/post/files/hdf5/look.hpp"
#include "tests/unit/post/small_run.hpp"

namespace fs = std::filesystem;

namespace {

const std::string coarse = case_text::with_line(case_text::plain, 9, "spacing = 0.2");

}  // namespace

TEST_CASE("run folder: the second run leaves nothing of the first") {
  const small_run::TemporaryFolder scratch;
  const cases::RunOptions options{scratch / "results", true};
  cases::run(case_text::read(coarse, {"output.probes.a=[0.5,0.5]"}), options);
  REQUIRE(fs::exists(options.folder / "probes.csv"));
  REQUIRE(fs::exists(options.folder / "fields.pvd"));
  std::ofstream(options.folder / "notes.txt") << "mine";
  cases::run(case_text::read(coarse, {"output.fields=[]"}), options);
  CHECK(fs::exists(options.folder / "history.csv"));
  CHECK(fs::exists(options.folder / "notes.txt"));
  for (const char* name : {"probes.csv", "fields.pvd", "fields_0000.vtu", "state.h5"}) {
    INFO(name);
    CHECK_FALSE(fs::exists(options.folder / name));
  }
}

TEST_CASE("the parts of a run share all of its time, with and without factors, at rest and in motion") {
  const auto motion = case_text::probed_motion();
  for (const auto& text : {coarse, coarse + "[srif]\n", motion, motion.substr(0, motion.find("[srif]"))})
    for (const char* formulation : {"ordinary", "galerkin"}) {
      CAPTURE(text, formulation);
      const small_run::TemporaryFolder scratch;
      cases::run(case_text::read(
                     text, {fmt::format("discretization.formulation={}", formulation), "discretization.spacing=0.2"}),
                 {scratch / "results", true});
      const auto json = nlohmann::json::parse(small_run::text_of(scratch / "results/summary.json"));
      double sum = 0;
      for (const auto& part : json["scene"]) sum += part["time_share"].get<double>();
      CHECK(sum == Approx(1).margin(1e-9));
    }
}

TEST_CASE("run folder: a case that is refused leaves the results of an earlier run, and a strange folder is refused") {
  const small_run::TemporaryFolder scratch;
  const cases::RunOptions options{scratch / "results", true};
  cases::run(case_text::read(coarse), options);
  const auto before = small_run::text_of(options.folder / "summary.json");
  CHECK_THROWS_AS(cases::run(case_text::read(coarse, {"support=[{kind=\"pinned\",points=[[0,0]]}]"}), options),
                  cases::CaseError);
  CHECK(small_run::text_of(options.folder / "summary.json") == before);
  fs::create_directories(scratch / "home");
  for (const char* name : {"a", "b", "c", "d"}) std::ofstream(scratch.path() / "home" / name) << "x";
  CHECK_THROWS_WITH(cases::run(case_text::read(coarse), {scratch / "home", true}),
                    Catch::Contains("holds a, b, ..., but no results of a run"));
  CHECK(std::distance(fs::directory_iterator(scratch / "home"), {}) == 4);
}

TEST_CASE("run folder: state.h5 alone holds what it holds beside fields") {
  const small_run::TemporaryFolder scratch;
  cases::run(case_text::read(coarse, {"output.fields=[\"hdf5\"]", "output.report=false"}), {scratch / "alone", true});
  cases::run(case_text::read(coarse, {"output.fields=[\"vtk\",\"hdf5\"]"}), {scratch / "both", true});
  const auto alone = post::read_run(scratch / "alone/state.h5"), both = post::read_run(scratch / "both/state.h5");
  CHECK(!alone.positions.empty());
  CHECK(alone.positions == both.positions);
  CHECK(alone.times == both.times);
  REQUIRE(alone.states.size() == 1);
  CHECK(alone.states[0] == both.states[0]);
  const hdf5_look::Look first(scratch / "alone/state.h5"), second(scratch / "both/state.h5");
  for (const char* name : {"/frames/moments", "/frames/shear_forces", "/frames/von_mises"}) {
    const auto numbers = first.numbers(name);
    CHECK(std::ranges::any_of(numbers, [](double number) { return number > 0; }));
    CHECK((numbers == second.numbers(name)));
  }
  CHECK_FALSE(fs::exists(scratch / "alone/fields.pvd"));
}

TEST_CASE("factors again: state.h5 of a run with loads in the plane gives N1 and N2 as the run does") {
  const small_run::TemporaryFolder scratch;
  const auto summary = cases::run(
      case_text::read(case_text::plain + "[srif]\n[output]\nfields = [\"hdf5\"]\nreport = false\n",
                      {"support[0].in_plane=\"fixed\"",
                       "load=[{kind='pressure',value=1},{kind='edge_traction',edges=['right'],tensor=[1,2,0.5]}]"}),
      {scratch / "run", true});
  const auto table = cases::srif_again(scratch / "run", {});
  REQUIRE(table.rows.size() == summary.srif.size());
  for (std::size_t i = 0; i < summary.srif.size(); ++i) {
    const auto& srif = summary.srif[i];
    if (srif.resolved[0]) CHECK(std::get<double>(table.rows[i][table.column("K1")]) == Approx(srif.K1));
    if (srif.membrane && srif.membrane->resolved[0])
      CHECK(std::get<double>(table.rows[i][table.column("N1")]) == Approx(srif.membrane->N[0]));
  }
  CHECK(summary.srif[0].membrane.has_value());
}

TEST_CASE("factors again: state.h5 of a run with large deflections gives all factors as the run does") {
  const small_run::TemporaryFolder scratch;
  const auto file = case_text::read(case_text::plain + "[srif]\n[output]\nfields = [\"hdf5\"]\nreport = false\n",
                                    {"support[0].in_plane=\"fixed\"", "analysis.nonlinear=true", "load[0].value=0.02"});
  const auto summary = cases::run(file, {scratch / "run", true});
  CHECK(*summary.deflection_over_thickness > 0.5);  // 4.5
  const auto table = cases::srif_again(scratch / "run", {});
  REQUIRE(table.rows.size() == summary.srif.size());
  std::size_t compared = 0;
  for (std::size_t i = 0; i < summary.srif.size(); ++i) {
    const auto& srif = summary.srif[i];
    if (srif.resolved[0]) CHECK(std::get<double>(table.rows[i][table.column("K1")]) == Approx(srif.K1));
    if (!srif.membrane || !srif.membrane->resolved[0]) continue;
    CHECK(std::get<double>(table.rows[i][table.column("N1")]) == Approx(srif.membrane->N[0]));
    ++compared;
  }
  CHECK(compared > 0);
  CHECK_THROWS_AS(cases::energy_check(file), cases::CaseError);
}

TEST_CASE("a linear run at rest tells by how much linear theory is off, where this may matter") {
  const auto run_of = [](const std::string& more, const std::vector<std::string>& settings) {
    const small_run::TemporaryFolder scratch;
    std::vector<std::string> all{"units=SI", "support[0].edges=[\"left\",\"right\",\"bottom\",\"top\"]",
                                 "support[0].in_plane=\"fixed\"", "discretization.spacing=0.1"};
    all.insert(all.end(), settings.begin(), settings.end());
    return cases::run(case_text::read(case_text::plain + more, all), {scratch / "run", true});
  };
  const auto warned = [](const post::Summary& summary) {
    return std::ranges::any_of(summary.warnings, [](const std::string& line) {
      return line.starts_with("linear theory overstates deflections by about") &&
             line.ends_with("set analysis.nonlinear = true");
    });
  };
  const auto deep = run_of("", {"load[0].value=1"});
  REQUIRE(deep.linear_theory_off);
  CHECK(*deep.linear_theory_off > 0.1);
  CHECK(warned(deep));
  const auto exact = run_of("", {"load[0].value=1", "analysis.nonlinear=true"});
  CHECK_FALSE(exact.linear_theory_off);
  const double off = *deep.deflection_over_thickness / *exact.deflection_over_thickness - 1;
  CHECK(*deep.linear_theory_off > off / 2);
  CHECK(*deep.linear_theory_off < off * 2);
  CHECK_FALSE(run_of("", {"load[0].value=0.01"}).linear_theory_off);
  CHECK_FALSE(run_of("", {"load[0].value=1e4"}).linear_theory_off);
  const auto bonds = run_of("", {"load[0].value=1", "discretization.formulation=ordinary"});
  CHECK(bonds.linear_theory_off.value() > 0.1);
  const std::string press = "load=[{kind='pressure',value=0.001},{kind='edge_traction',edges=['right'],value=-0.1}]";
  const auto pressed = run_of("", {press, "support[0].in_plane=\"normal\"", "support[0].edges=[\"left\",\"bottom\"]"});
  REQUIRE(pressed.linear_theory_off);  // however small deflections are
  CHECK(*pressed.linear_theory_off < 0);
  const auto of_cases = run_of(
      "[[case]]\nname = \"a\"\nload = [{ kind = \"pressure\", value = 0.1 }]\n"
      "[[case]]\nname = \"b\"\nload = [{ kind = \"pressure\", value = 1 }]\n",
      {"-load"});
  REQUIRE(of_cases.linear_theory_off);
  CHECK(*of_cases.linear_theory_off == Approx(*deep.linear_theory_off).epsilon(1e-3));
  CHECK(warned(of_cases));
}

TEST_CASE("factors: twice the spacing widens the errors of N1 and N2") {
  const small_run::TemporaryFolder scratch;
  const auto factors = [&](const std::vector<std::string>& more) {
    std::vector<std::string> settings{"support[0].in_plane=\"fixed\"",
                                      "load=[{kind='pressure',value=1},{kind='edge_traction',edges=['right'],"
                                      "tensor=[1,2,0.5]}]"};
    settings.insert(settings.end(), more.begin(), more.end());
    const auto text = case_text::plain + "[srif]\nmethods = [\"domain_integral\"]\n[output]\nfields = []\n";
    return cases::run(case_text::read(text, settings), {scratch / "run", true}).srif;
  };
  const double at_tips = 2 * 0.1 / std::sqrt(10.0) / 6;  // twice a sixth of the layer
  const auto own = factors({}), both = factors({"srif.richardson=true"}),
             coarser = factors({"discretization.spacing=0.1", "discretization.spacing_growth=0.2",
                                fmt::format("discretization.tip_spacing={:.17g}", at_tips)});
  REQUIRE(both.size() == own.size());
  for (std::size_t tip = 0; tip < both.size(); ++tip)
    for (std::size_t i = 0; i < 2; ++i) {
      const auto &one = *own[tip].membrane, &wide = *both[tip].membrane;
      CHECK(wide.N[i] == one.N[i]);
      CHECK(*wide.errors[i] ==
            Approx(std::max(one.errors[i].value_or(0), std::abs(one.N[i] - coarser[tip].membrane->N[i]))));
    }
}
