// Surface nodes through the program: case files, results, refusals.
#include <algorithm>
#include <filesystem>

#include "cases/driver/run.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/post/small_run.hpp"
#include "tests/verification/boundary/local_plate.hpp"

namespace {

const std::vector<std::string> clamped{"geometry.cracks=[]", "support[0].edges=[\"left\",\"right\",\"bottom\",\"top\"]",
                                       "discretization.boundary=surface_nodes",
                                       "discretization.volume_correction=lattice_fitted", "analysis.method=direct"};

std::vector<std::string> with(std::vector<std::string> settings, const std::string& more) {
  settings.push_back(more);
  return settings;
}

/// Everything that is wrong with a case, in one text.
std::string wrong(const std::vector<std::string>& settings) {
  const small_run::TemporaryFolder folder;
  try {
    cases::run(case_text::read(case_text::plain, settings), {folder / "run", true});
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("surface nodes in a case: a clamped plate under pressure, its reactions, probes and files") {
  const small_run::TemporaryFolder folder;
  const auto summary = cases::run(
      case_text::read(case_text::plain + "[output]\nprobes = { centre = [0.0, 0.0], edge = [0.0, 1.0] }\n", clamped),
      {folder / "run", true});
  CHECK(summary.formulation == "surface_nodes");
  const plate::Section section{1000, 0.3, 0.1};
  const double w =
      boundary_bodies::RitzPlate(section, 2, 1, plate::SupportKind::clamped, plate::SupportKind::clamped, 7)
          .deflection(0, 0);
  CHECK(std::abs(summary.reactions->largest_residual) < 1e-9);  // measured: 3e-13
  for (const auto& one : summary.reactions->largest) CHECK(one.force == Approx(-1).epsilon(1e-6));
  const auto probes = post::read_csv(folder / "run" / "probes.csv");
  const auto probe = [&](const std::string& name) {
    for (const auto& row : probes.rows)
      if (std::get<std::string>(row[probes.column("probe")]) == name) return std::get<double>(row[probes.column("w")]);
    return 0.0;
  };
  // 0.64 % off by the clamp, the rest by linear interpolation between four points
  CHECK(probe("centre") == Approx(w).epsilon(0.012));  // measured: 0.0099
  CHECK(std::abs(probe("edge")) < 2e-3 * w);           // measured: 1.0e-3, between surface nodes
  CHECK(std::filesystem::exists(folder / "run" / "fields_0000.vtu"));
}

TEST_CASE("surface nodes in a case: reactions beside free edges balance, the energy of coarse points is warned of") {
  const small_run::TemporaryFolder folder;
  auto settings = clamped;
  settings[1] = "support[0].edges=[\"left\"]", settings.push_back("discretization.spacing=0.1"),
  settings.push_back("section.thickness=0.2");
  const auto summary = cases::run(case_text::read(case_text::plain, settings), {folder / "run", true});
  const auto says = [&](const std::string& what) {
    return std::ranges::any_of(summary.warnings, [&](const auto& one) { return one.find(what) != std::string::npos; });
  };
  CHECK(summary.reactions->largest_residual < 0.003);  // measured: 0.0017; 0.044 by the faces of the held edge alone
  CHECK(says("the points are coarse"));
  settings.push_back("section.thickness=0.02");
  CHECK(wrong(settings).find("times the thickness") != std::string::npos);
  settings[1] = "support=[{kind=\"simply_supported\",edges=[\"left\",\"bottom\"]}]";
  settings.push_back("section.thickness=0.22"), settings.push_back("discretization.spacing=0.14285714285714285");
  CHECK(wrong(settings).find("the points are coarse") != std::string::npos);  // measured: 34 % apart
}

TEST_CASE("surface nodes in a case: an L with edges off the lattice against the Galerkin plate, and its reactions") {
  const std::string ell =
      "[geometry]\noutline = { polygon = [[0,0],[2,0],[2,1],[1,1],[1,2],[0,2]], edges = "
      "[\"all\",\"all\",\"all\",\"all\",\"all\",\"all\"] }\n[section]\nyoung = 1000.0\npoisson = 0.3\n"
      "thickness = 0.2\n[[support]]\nkind = \"clamped\"\nedges = [\"all\"]\n[[load]]\nkind = \"pressure\"\nvalue = "
      "1.0\n[analysis]\nkind = \"static\"\n[output]\nprobes = { a = [0.5, 0.5] }\n[discretization]\nspacing = 0.0703\n";
  const auto deflection = [&](const std::vector<std::string>& settings) {
    const small_run::TemporaryFolder folder;
    const auto summary = cases::run(case_text::read(ell, settings), {folder / "run", true});
    CHECK(summary.reactions->largest_residual < 0.002);  // measured: 5.5e-4
    const auto probes = post::read_csv(folder / "run" / "probes.csv");
    return std::get<double>(probes.rows.at(0)[probes.column("w")]);
  };
  const double w = deflection({"discretization={formulation=\"galerkin\",spacing=0.025}"});
  const double by_nodes =
      deflection({"discretization.boundary=surface_nodes", "discretization.volume_correction=lattice_fitted"});
  INFO(w << ' ' << by_nodes);
  CHECK(by_nodes == Approx(w).epsilon(0.03));  // measured: 0.0266, with 14 points across an arm
}

TEST_CASE("surface nodes in a case: what they cannot serve is refused with the reason, by its key") {
  CHECK(wrong(with(clamped, "analysis.method=cg")).find("not symmetric") != std::string::npos);
  CHECK(wrong(with(clamped, "-analysis.method")) == "");  // then direct
  CHECK(wrong(with(clamped, "analysis.method=adr")).find("analysis.method") != std::string::npos);
  CHECK(wrong(with(with(clamped, "section.density=1"), "analysis={kind=\"frequencies\"}")).find("not symmetric") !=
        std::string::npos);
  CHECK(wrong(with(with(clamped, "section.density=1"), "analysis={kind=\"dynamic\", duration=0.1}"))
            .find("not symmetric") != std::string::npos);
  CHECK(wrong(with(clamped, "geometry.cracks=[[[-0.9,0],[0.3,0]]]")).find("more than a horizon") != std::string::npos);
  CHECK(wrong(with(clamped,
                   "geometry.outline={polygon=[[-1,-1],[1,-1],[0.5,1],[-1,1]], "
                   "edges=[\"bottom\",\"right\",\"top\",\"left\"]}")) == "");  // oblique edges are served
  CHECK(wrong(with(clamped, "geometry.holes=[{circle=[0,0,0.05]}]")).find("two horizons") != std::string::npos);
  CHECK(wrong(with(clamped, "discretization.formulation=galerkin")).find("on the edges themselves") !=
        std::string::npos);
  CHECK(wrong(with(clamped, "support[0].kind=clamped_layer")).find("not layers") != std::string::npos);
  CHECK(wrong(with(clamped, "load=[{kind=\"edge_moment\",value=1,edges=[\"left\"]}]")).find("is held") !=
        std::string::npos);
}
