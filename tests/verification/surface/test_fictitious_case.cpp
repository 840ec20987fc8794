// Fictitious nodes through the program: case files, results, refusals.
#include <algorithm>

#include "cases/driver/run.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/post/small_run.hpp"
#include "tests/verification/boundary/local_plate.hpp"

namespace {

const std::vector<std::string> clamped{"geometry.cracks=[]", "support[0].edges=[\"left\",\"right\",\"bottom\",\"top\"]",
                                       "discretization.boundary=fictitious_nodes", "discretization.spacing=0.08",
                                       "section.thickness=0.2"};

std::vector<std::string> with(std::vector<std::string> settings, const std::string& more) {
  settings.push_back(more);
  return settings;
}

post::Summary run(const std::vector<std::string>& settings, const small_run::TemporaryFolder& folder) {
  return cases::run(
      case_text::read(case_text::plain + "[output]\nprobes = { centre = [0.0, 0.0], edge = [0.0, 1.0] }\n", settings),
      {folder / "run", true});
}

/// Everything that is wrong with a case, in one text; no folder is made.
std::string wrong(const std::vector<std::string>& settings) {
  const small_run::TemporaryFolder folder;
  try {
    run(settings, folder);
  } catch (const std::exception& error) {
    CHECK(folder.entries() == 0);
    return error.what();
  }
  return "";
}

double probe(const small_run::TemporaryFolder& folder, const std::string& name) {
  const auto probes = post::read_csv(folder / "run" / "probes.csv");
  for (const auto& row : probes.rows)
    if (std::get<std::string>(row[probes.column("probe")]) == name) return std::get<double>(row[probes.column("w")]);
  return 0;
}

}  // namespace

TEST_CASE(
    "fictitious nodes in a case: clamped and hard supported plates under pressure, reactions, edges, multipliers") {
  using enum plate::SupportKind;
  for (const auto& [name, kind] :
       {std::pair{"clamped", clamped}, std::pair{"simply_supported_hard", simply_supported_hard}}) {
    const small_run::TemporaryFolder folder;
    const auto summary = run(with(::clamped, std::string("support[0].kind=") + name), folder);
    CHECK(summary.formulation == "fictitious_nodes");
    CHECK(summary.analysis.method == "direct");
    CHECK(std::abs(summary.reactions->largest_residual) < 1e-9);  // measured: 1e-12
    for (const auto& one : summary.reactions->largest)
      CHECK(one.force == Approx(-1).epsilon(0.01));  // measured: 0.0003, 0.0036
    const double w = boundary_bodies::RitzPlate({1000, 0.3, 0.2}, 2, 1, kind, kind, 7).deflection(0, 0);
    CHECK(probe(folder, "centre") == Approx(w).epsilon(0.012));  // measured: 0.0032, 0.0094
    CHECK(std::abs(probe(folder, "edge")) < 1e-9 * w);
    CHECK(*summary.multipliers == Approx(0.21).epsilon(0.15));  // measured: 0.237, 0.193
  }
}

TEST_CASE("fictitious nodes in a case: multipliers as large as the loads are warned of, larger ones end the run") {
  const small_run::TemporaryFolder folder;
  const auto coarse = with(with(clamped, "section.thickness=0.1"), "discretization.spacing=0.1");
  const auto summary = run(coarse, folder);
  CHECK(*summary.multipliers == Approx(1.076).epsilon(0.01));  // measured: 1.0757
  CHECK(std::ranges::any_of(summary.warnings, [](const auto& one) { return one.starts_with("multipliers add"); }));
  // moments on free edges that meet held ones: 7 % below the plate with images
  const std::vector<std::string> moments{"geometry.cracks=[]",
                                         "discretization.boundary=fictitious_nodes",
                                         "discretization.spacing=0.04",
                                         "section.thickness=0.2",
                                         "support[0].edges=[\"bottom\",\"top\"]",
                                         "support[0].kind=simply_supported",
                                         "load=[{kind=\"edge_moment\",value=1,edges=[\"left\",\"right\"]}]"};
  const small_run::TemporaryFolder ended;
  CHECK_THROWS_WITH(run(moments, ended), Catch::Contains("multipliers add forces of 3.7"));
}

TEST_CASE("fictitious nodes in a case: a horizon too wide for soft and free edges is refused, and for few points any") {
  CHECK(wrong(with(clamped, "support[0].kind=simply_supported")).find("times the thickness") != std::string::npos);
  CHECK(wrong(with(clamped, "support[0].edges=[\"left\",\"right\"]")).find("fictitious nodes here allow") !=
        std::string::npos);
  CHECK(wrong(with(clamped, "discretization.spacing=0.125")).find("of the narrowest part") != std::string::npos);
  CHECK(wrong(with(clamped, "discretization.spacing=0.0813")).find("beyond a row of points") != std::string::npos);
}

TEST_CASE("fictitious nodes in a case: what they cannot serve is refused with the reason, by its key") {
  const auto refuses = [](const std::string& setting, const std::string& reason) {
    INFO(setting);
    CHECK_THAT(wrong(with(clamped, setting)), Catch::Contains(reason));
  };
  for (const auto* method : {"cg", "adr"}) refuses(std::string("analysis.method=") + method, "not symmetric");
  refuses("analysis={kind=\"frequencies\"}", "not symmetric");
  refuses("analysis={kind=\"dynamic\", duration=0.1}", "not symmetric");
  refuses("growth={fracture_energy=1}", "not symmetric");
  refuses("geometry.holes=[{circle=[0.5,0.5,0.2]}]", "fictitious nodes are of edges along the axes");
  refuses("geometry.outline={polygon=[[-1,-1],[1,-1],[0.5,1],[-1,1]], edges=[\"bottom\",\"right\",\"top\",\"left\"]}",
          "fictitious nodes are of edges along the axes");
  refuses("geometry.cracks=[[[-0.9,0],[0.3,0]]]", "more than a horizon");
  refuses("discretization.formulation=galerkin", "on the edges themselves");
  refuses("support[0].kind=clamped_layer", "not layers");
  refuses("load=[{kind=\"edge_moment\",value=1,edges=[\"left\"]}]", "is held");
}
