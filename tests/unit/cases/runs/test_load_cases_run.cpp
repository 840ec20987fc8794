// Load cases against runs of their own, combinations against runs of the combined loads.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "cases/driver/run.hpp"
#include "cases/input/validation.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/discretised.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/files/factor_rows.hpp"
#include "post/files/hdf5/state_file.hpp"
#include "post/files/results_in_memory.hpp"
#include "post/files/summary.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

const std::string no_load = with_line(with_line(with_line(plain, 13, ""), 14, ""), 15, "") +
                            "tolerance = 1e-12\nmethod = \"direct\"\n[srif]\n[output]\nprobes = { a = [0.5, 0.7] }\n";
const std::string first = "kind = \"pressure\"\ngravity = -10\n",
                  second = "kind = \"point_force\"\nvalue = VALUE\nposition = [0.6, -0.5]\n",
                  third = "kind = \"edge_moment\"\nvalue = VALUE\nedges = [\"right\"]\n";

std::string scaled(std::string load, const std::string& value) {
  if (const auto at = load.find("VALUE"); at != std::string::npos) return load.replace(at, 5, value);
  return load.replace(load.find("-10"), 3, value);
}

const std::string cases_of_three = no_load + "[[case]]\nname = \"dead\"\n[[case.load]]\n" + first +
                                   "[[case]]\nname = \"force\"\n[[case.load]]\n" + scaled(second, "0.4") +
                                   "[[case]]\nname = \"moment\"\n[[case.load]]\n" + scaled(third, "-0.3") +
                                   "[[combination]]\nname = \"all\"\nof = { dead = 1.35, force = -2, moment = 1.5 }\n";

struct Run {
  post::ResultsInMemory in_memory;
  post::Summary summary;
};

Run run(const std::string& text, const std::string& formulation, const std::vector<std::string>& more = {}) {
  Run result;
  std::vector<std::string> settings{"discretization.formulation=" + formulation, "section.density=3"};
  settings.insert(settings.end(), more.begin(), more.end());
  result.in_memory.wants_fields = true;
  result.summary = cases::run(read(text, settings), {{}, true, &result.in_memory});
  return result;
}

double number(const post::Cell& cell) {
  return std::get<double>(cell);
}

const post::Table& table_of(const Run& run, const std::string& name) {
  for (const auto& [own, table] : run.in_memory.tables)
    if (own == name) return table;
  throw std::out_of_range(name);
}

/// Factors, errors, reactions and probes of a load case are those of a run under its loads alone.
void compare(const post::LoadCaseSummary& one, const Run& all, std::size_t number_of_case, const Run& alone) {
  INFO(one.name);
  REQUIRE(one.srif.size() == alone.summary.srif.size());
  double largest = 0;
  for (const auto& srif : alone.summary.srif) largest = std::max({largest, std::abs(srif.K1), std::abs(srif.K2)});
  for (std::size_t i = 0; i < one.srif.size(); ++i) {
    const auto &a = one.srif[i], &b = alone.summary.srif[i];
    CHECK(a.method == b.method);
    CHECK(std::abs(a.K1 - b.K1) < 1e-10 * largest);  // measured: see the combination, below
    CHECK(std::abs(a.K2 - b.K2) < 1e-10 * largest);
    CHECK(std::abs(a.K3 - b.K3) * 0.1 < 1e-10 * largest);
    if (one.of.empty())
      CHECK(a.errors[0].value_or(0) == Approx(b.errors[0].value_or(0)).epsilon(1e-6).margin(1e-9 * largest));
    else  // at least those of the parts
      CHECK(a.errors[0].value_or(0) > b.errors[0].value_or(0) * (1 - 1e-6) - 1e-9 * largest);
  }
  const auto &probes = table_of(all, "probes"), &own = table_of(alone, "probes");
  const double w = number(probes.rows.at(number_of_case - 1)[probes.column("w")]);
  CHECK(w == Approx(number(own.rows.at(0)[own.column("w")])).epsilon(1e-10));
  CHECK(one.reactions->balance.supports[0].force ==
        Approx(alone.summary.reactions->balance.supports[0].force).epsilon(1e-9).margin(1e-9));
  CHECK(one.reactions->balance.residual < 1e-9);
}

}  // namespace

TEST_CASE("load cases: each is what it is alone, and a combination what its loads are together") {
  for (const std::string formulation : {"galerkin", "ordinary"}) {
    std::vector<std::string> lattice{"discretization.spacing=0.1"};
    if (formulation == "galerkin") lattice.push_back("discretization.refine_tips=false");
    const auto all = run(cases_of_three, formulation, lattice);
    const auto& found = all.summary.load_cases;
    REQUIRE(found.size() == 4);
    const auto alone = [&](const std::string& loads) {
      // points stand where any load case has a force: none of it here
      const auto idle = "[[load]]\n" + scaled(second, "0");
      return run(no_load + loads + (loads.find("0.6") == std::string::npos ? idle : ""), formulation, lattice);
    };
    compare(found[0], all, 1, alone("[[load]]\n" + first));
    compare(found[1], all, 2, alone("[[load]]\n" + scaled(second, "0.4")));
    compare(found[2], all, 3, alone("[[load]]\n" + scaled(third, "-0.3")));
    compare(found[3], all, 4,
            alone("[[load]]\n" + scaled(first, "-13.5") + "[[load]]\n" + scaled(second, "-0.8") + "[[load]]\n" +
                  scaled(third, "-0.45")));
    CHECK(all.summary.srif.empty());
    CHECK(all.summary.outcome == "done");
    CHECK(all.in_memory.frames.size() == 4);
    const auto& srifs = table_of(all, "srif");
    CHECK(srifs.columns.back() == "case");
    CHECK(table_of(all, "envelope").rows.size() == all.summary.envelope.size());
    CHECK(table_of(all, "reactions").columns.back() == "case");
    CHECK(table_of(all, "history").rows.size() == 4);
  }
}

TEST_CASE("load cases: twice the spacing and the other formulation bound the errors of each as they do alone") {
  const std::vector<std::string> fine{"discretization.spacing=0.05", "discretization.refine_tips=false",
                                      "geometry.cracks=[[[-0.5,0.0],[0.5,0.0]]]"};
  for (const std::string how : {"richardson", "second_formulation"}) {
    INFO(how);
    auto settings = fine;
    settings.push_back("srif." + how + "=true");
    const auto all = run(cases_of_three, "galerkin", settings), without = run(cases_of_three, "galerkin", fine);
    const auto idle = "[[load]]\n" + scaled(second, "0");
    const auto alone = run(no_load + "[[load]]\n" + scaled(third, "-0.3") + idle, "galerkin", settings);
    const auto &moment = all.summary.load_cases[2], &sum = all.summary.load_cases[3];
    REQUIRE(moment.srif.size() == alone.summary.srif.size());
    bool wider = false;
    for (std::size_t i = 0; i < moment.srif.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto of_run = alone.summary.srif[i].errors[k], own = without.summary.load_cases[2].srif[i].errors[k];
        if (!of_run) continue;
        CHECK(*moment.srif[i].errors[k] == Approx(*of_run).epsilon(1e-6).margin(1e-12));
        wider = wider || *moment.srif[i].errors[k] > 1.01 * *own;
        CHECK(*sum.srif[i].errors[k] >= 1.5 * *moment.srif[i].errors[k] * (1 - 1e-9));
      }
      if (how == "second_formulation" && i == 0) CHECK(moment.srif[i].second->formulation == "ordinary");
    }
    CHECK(wider);
  }
}

TEST_CASE("load cases: by conjugate gradients as exactly as these are asked for") {
  const std::vector<std::string> cg{"discretization.spacing=0.1", "analysis.method=cg", "analysis.tolerance=1e-9"};
  const auto direct = run(cases_of_three, "galerkin", {"discretization.spacing=0.1"});
  const auto found = run(cases_of_three, "galerkin", cg);
  for (std::size_t n = 0; n < 4; ++n)
    CHECK(found.summary.load_cases[n].srif[0].K1 ==
          Approx(direct.summary.load_cases[n].srif[0].K1).epsilon(1e-6));  // measured: 1e-9
}

TEST_CASE("load cases: what cancels in a combination leaves its errors, and a plate at rest where all of it does") {
  const auto text = cases_of_three + "[[case]]\nname = \"again\"\n[[case.load]]\n" + scaled(first, "-10.1") +
                    "[[combination]]\nname = \"little\"\nof = { dead = 1, again = -1 }\n" +
                    "[[combination]]\nname = \"nothing\"\nof = { dead = 1.01, again = -1 }\n";
  for (const std::string formulation : {"galerkin", "ordinary"}) {
    const auto all = run(text, formulation, {"discretization.spacing=0.1"});
    const auto& found = all.summary.load_cases;
    REQUIRE(found.size() == 7);
    const auto &dead = found[0], &again = found[3], &little = found[5], &nothing = found[6];
    CHECK(little.residual.value() < 1e-9);
    for (std::size_t i = 0; i < dead.srif.size(); ++i) {
      CHECK(little.srif[i].K1 == Approx(dead.srif[i].K1 - again.srif[i].K1).epsilon(1e-6));
      if (!dead.srif[i].errors[0]) continue;
      CHECK(little.srif[i].errors[0].value() ==
            Approx(std::hypot(*dead.srif[i].errors[0], *again.srif[i].errors[0])).epsilon(1e-12));
      CHECK(nothing.srif[i].K1 == 0);
      CHECK(nothing.srif[i].errors[0].value() > *again.srif[i].errors[0]);
    }
    CHECK(nothing.reactions->balance.loads.force == 0);
    CHECK(all.summary.outcome == "done");
    CHECK_THAT(fmt::format("{}", fmt::join(all.summary.warnings, "; ")),
               Catch::Contains("combination nothing: its loads cancel") && !Catch::Contains("no load reaches"));
  }
}

TEST_CASE("load cases: factors found again in the states have names and the errors of combinations") {
  const auto file = read(cases_of_three, {"section.density=3", "discretization.spacing=0.1"});
  const auto all = run(cases_of_three, file.content.discretization.formulation->name, {"discretization.spacing=0.1"});
  const auto plate = plate::discretise(file.content).plate;
  const auto& srif = *file.content.srif;
  post::StoredRun stored{std::vector<Eigen::Vector2d>(plate->cloud().plate_points), {}, {}};
  for (const auto& frame : all.in_memory.frames) {
    plate::State state(3, Eigen::Index(stored.positions.size()));
    const auto &w = frame.arrays.at("w").values, &theta = frame.arrays.at("theta").values;
    for (Eigen::Index k = 0; k < state.cols(); ++k)
      state.col(k) << w[std::size_t(k)], theta[2 * std::size_t(k)], theta[2 * std::size_t(k) + 1];
    stored.times.push_back(frame.time), stored.states.push_back(state);
  }
  const auto again = post::stored_factors(stored, *plate, srif, post::tip_methods(*plate, srif));
  const auto& first = table_of(all, "srif");
  REQUIRE(again.columns == first.columns);
  REQUIRE(again.rows.size() == first.rows.size());
  const auto error = first.column("estimated_error_K1"), name = first.column("case");
  for (std::size_t row = 0; row < first.rows.size(); ++row) {
    CHECK(again.rows[row][name] == first.rows[row][name]);
    if (const auto* of_run = std::get_if<double>(&first.rows[row][error]))
      CHECK(number(again.rows[row][error]) == Approx(*of_run).epsilon(1e-9));
  }
  stored.times.push_back(9), stored.states.push_back(stored.states[0]);
  CHECK_THROWS_WITH(post::stored_factors(stored, *plate, srif, post::tip_methods(*plate, srif)),
                    Catch::Contains("does not belong"));
}

TEST_CASE("load cases: a load case that fails is named, and those before it are written") {
  post::ResultsInMemory in_memory;
  in_memory.wants_fields = true;
  const auto file = read(cases_of_three, {"section.density=3", "analysis.method=cg", "analysis.max_iterations=1",
                                          "analysis.preconditioner=diagonal", "discretization.formulation=ordinary"});
  CHECK_THROWS_WITH(cases::run(file, {{}, true, &in_memory}), Catch::Contains("dead, cg: not converged"));
  CHECK_THAT(in_memory.summary, Catch::Contains("\"outcome\": \"failed: dead"));
}
