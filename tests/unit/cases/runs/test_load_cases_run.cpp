// Load cases against runs of their own, combinations against runs of the combined loads.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <set>

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

TEST_CASE("load cases: twice the spacing bounds the errors of N1 and N2 of each, and combinations have their share") {
  const std::string pulled = cases_of_three +
                             "[[case]]\nname = \"pull\"\n[[case.load]]\nkind = \"edge_traction\"\n"
                             "edges = [\"bottom\", \"top\"]\nvalue = 2.0\n"
                             "[[combination]]\nname = \"half\"\nof = { pull = 0.5, dead = 1 }\n";
  const std::vector<std::string> fine{"discretization.spacing=0.05", "discretization.refine_tips=false",
                                      "geometry.cracks=[[[-0.5,0.0],[0.5,0.0]]]", "support[0].in_plane=\"fixed\""};
  auto settings = fine;
  settings.emplace_back("srif.richardson=true");
  const auto all = run(pulled, "galerkin", settings), without = run(pulled, "galerkin", fine);
  const auto &pull = all.summary.load_cases[3].srif, &half = all.summary.load_cases[5].srif;
  const auto& own = without.summary.load_cases[3].srif;
  REQUIRE(!pull.empty());
  bool wider = false;
  for (std::size_t i = 0; i < pull.size(); ++i) {
    REQUIRE(pull[i].membrane);
    const auto &error = pull[i].membrane->errors[0], &before = own[i].membrane->errors[0];
    if (!error || !before) continue;
    wider = wider || *error > 1.01 * *before;
    CHECK(*half[i].membrane->errors[0] >= 0.5 * *error * (1 - 1e-9));
  }
  CHECK(wider);
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

namespace {

const std::string pull = "kind = \"edge_traction\"\nedges = [\"top\"]\nvalue = VALUE\n",
                  drag = "kind = \"body_force\"\nvector = [VALUE, 0.1]\n",
                  press = "kind = \"pressure\"\nvalue = VALUE\n";

std::string load_case(const std::string& name, const std::vector<std::string>& loads) {
  std::string text = "[[case]]\nname = \"" + name + "\"\n";
  for (const auto& load : loads) text += "[[case.load]]\n" + load;
  return text;
}

const std::string cases_in_plane = no_load + load_case("pull", {scaled(pull, "2")}) +
                                   load_case("drag", {scaled(drag, "0.3"), scaled(press, "0.5")}) +
                                   load_case("bend", {scaled(press, "1")}) +
                                   "[[combination]]\nname = \"all\"\nof = { pull = 1.5, drag = 1, bend = -2 }\n";

Run run_in_plane(const std::string& text, std::vector<std::string> more = {}) {
  more.insert(more.end(), {"discretization.refine_tips=false", "srif.toughness=50",
                           "support=[{ kind = 'clamped', edges = ['left'], in_plane = 'fixed' }]"});
  return run(text, "galerkin", more);
}

/// Results in the plane of a load case are those of a run under its loads alone.
void compare_in_plane(const post::LoadCaseSummary& one, const Run& all, std::size_t number_of_case, const Run& alone) {
  INFO(one.name);
  REQUIRE(one.srif.size() == alone.summary.srif.size());
  double largest = 0;
  for (const auto* srif : post::recommended(alone.summary.srif))
    largest = std::max(largest, std::abs(srif->membrane.value().N[0]));
  for (std::size_t i = 0; i < one.srif.size(); ++i) {
    const auto &a = one.srif[i].membrane, &b = alone.summary.srif[i].membrane;
    REQUIRE(a.has_value() == b.has_value());
    for (std::size_t k = 0; a && k < 2; ++k) {
      CHECK(std::abs(a->N[k] - b->N[k]) < 1e-9 * largest);
      CHECK(a->errors[k].value_or(0) >= b->errors[k].value_or(0) * (1 - 1e-6) - 1e-9 * largest);
    }
    const auto &used = one.faces[i].utilisation, &expected = alone.summary.faces[i].utilisation;
    REQUIRE(used.has_value() == expected.has_value());
    if (used) CHECK(*used == Approx(*expected).epsilon(1e-8));
  }
  const auto &probes = table_of(all, "probes"), &own = table_of(alone, "probes");
  for (const std::string name : {"u", "v"})
    CHECK(number(probes.rows.at(number_of_case - 1)[probes.column(name)]) ==
          Approx(number(own.rows.at(0)[own.column(name)])).epsilon(1e-9));
  REQUIRE(one.membrane);
  const auto& single = alone.summary.membrane.value();
  REQUIRE(one.membrane->reactions.size() == single.reactions.size());
  for (std::size_t i = 0; i < single.reactions.size(); ++i)
    CHECK((one.membrane->reactions[i].force - single.reactions[i].force).norm() <=
          1e-9 * single.reactions[i].force.norm());
  CHECK(one.membrane->strain_energy == Approx(single.strain_energy).epsilon(1e-9));
  CHECK(one.membrane->external_work == Approx(single.external_work).epsilon(1e-9));
  const auto stress = [](const std::vector<post::Peak>& peaks) {
    return std::ranges::find(peaks, "von_mises", &post::Peak::quantity)->value;
  };
  CHECK(stress(one.extremes) == Approx(stress(alone.summary.extremes)).epsilon(1e-8));
}

}  // namespace

TEST_CASE("load cases: in the plane each is what it is alone, and a combination what its loads are together") {
  const auto all = run_in_plane(cases_in_plane);
  const auto& found = all.summary.load_cases;
  REQUIRE(found.size() == 4);
  const auto alone = [](const std::vector<std::string>& loads) {
    std::string text = no_load;
    for (const auto& load : loads) text += "[[load]]\n" + load;
    return run_in_plane(text);
  };
  const auto pulled = alone({scaled(pull, "2")}), bent = alone({scaled(press, "1")});
  compare_in_plane(found[0], all, 1, pulled);
  compare_in_plane(found[1], all, 2, alone({scaled(drag, "0.3"), scaled(press, "0.5")}));
  compare_in_plane(found[3], all, 4, alone({scaled(pull, "3"), scaled(drag, "0.3"), scaled(press, "-1.5")}));

  CHECK_FALSE(bent.summary.membrane);  // and a load case without loads in the plane rests there
  CHECK(found[2].membrane->strain_energy == 0);
  CHECK(found[2].membrane->largest_displacement == 0);
  REQUIRE(found[2].srif.size() == bent.summary.srif.size());
  for (std::size_t i = 0; i < found[2].srif.size(); ++i) {
    CHECK(found[2].srif[i].K1 == Approx(bent.summary.srif[i].K1).epsilon(1e-9));
    if (const auto& membrane = found[2].srif[i].membrane) CHECK(membrane->N[0] == 0);
    CHECK(found[0].srif[i].K1 == 0);
  }
  CHECK_THAT(fmt::format("{}", fmt::join(all.summary.warnings, "; ")),
             !Catch::Contains("no load reaches") && !Catch::Contains("cancel"));
  for (const auto& frame : all.in_memory.frames) CHECK(frame.arrays.contains("membrane_forces"));
  CHECK(table_of(all, "srif").columns.back() == "case");
  CHECK_NOTHROW(table_of(all, "srif").column("N1"));
  std::set<std::string> quantities;
  for (const auto& entry : all.summary.envelope) quantities.insert(entry.quantity);
  CHECK(quantities == std::set<std::string>{"K1", "K2", "K3", "G", "N1", "N2", "K_eq", "utilisation"});
  const auto json = nlohmann::json::parse(all.in_memory.summary).at("load_cases");
  CHECK(json.at(0).at("membrane").at("reactions").at(0).at("force_y").get<double>() ==
        Approx(-4));  // 2 on an edge of the length 2
  CHECK(json.at(0).at("srif").at(0).at("faces").contains("utilisation"));
}

TEST_CASE("load cases: loads in the plane that cancel in a combination leave its bending, and errors") {
  const auto all = run_in_plane(cases_in_plane + load_case("half", {scaled(pull, "1")}) +
                                "[[combination]]\nname = \"bent\"\nof = { pull = 1, half = -2, bend = 1 }\n");
  const auto& found = all.summary.load_cases;
  REQUIRE(found.size() == 6);
  const auto &bend = found[2], &bent = found[5];
  CHECK(bent.membrane->strain_energy == 0);
  for (std::size_t i = 0; i < bent.srif.size(); ++i) {
    CHECK(bent.srif[i].K1 == Approx(bend.srif[i].K1).epsilon(1e-9));
    const auto &membrane = bent.srif[i].membrane, &of_part = found[0].srif[i].membrane;
    if (!membrane) continue;
    CHECK(membrane->N[0] == 0);
    if (of_part->errors[0]) CHECK(membrane->errors[0].value() > *of_part->errors[0]);
  }
  CHECK_THAT(
      fmt::format("{}", fmt::join(all.summary.warnings, "; ")),
      Catch::Contains("combination bent: its loads in the plane cancel") && !Catch::Contains("plate stays at rest"));
}

TEST_CASE("load cases: one that is not in equilibrium in the plane is named") {
  CHECK_THROWS_WITH(run_in_plane(cases_in_plane, {"analysis.method=cg", "analysis.max_iterations=1",
                                                  "analysis.preconditioner=diagonal"}),
                    Catch::Contains("in the plane, pull: not converged"));
}

TEST_CASE("load cases: without loads in the plane nothing is stored for them") {
  const auto all = run(cases_of_three, "galerkin", {"discretization.spacing=0.1"});
  CHECK_FALSE(all.summary.load_cases[0].membrane);
  CHECK_THROWS_AS(table_of(all, "srif").column("N1"), std::out_of_range);
  CHECK_THROWS_AS(table_of(all, "probes").column("u"), std::out_of_range);
  for (const auto& entry : all.summary.envelope) CHECK(entry.quantity != "utilisation");
  CHECK_THAT(all.in_memory.summary, !Catch::Contains("membrane"));
}

namespace {

/// Thick enough for deflections of the order of the thickness.
Run run_curved(const std::string& text) {
  return run(text, "galerkin",
             {"discretization.spacing=0.1", "discretization.refine_tips=false", "section.young=2e4",
              "analysis.nonlinear=true", "analysis.tolerance=1e-9", "analysis.method=cg", "srif.toughness=50",
              "support=[{ kind = 'clamped', edges = ['left', 'bottom', 'top'], in_plane = 'fixed' }]"});
}

/// A load case with large deflections is a run with large deflections under its loads alone.
void compare_curved(const post::LoadCaseSummary& one, const Run& all, std::size_t number_of_case, const Run& alone) {
  INFO(one.name);
  REQUIRE(one.srif.size() == alone.summary.srif.size());
  double bending = 0, in_plane = 0;
  for (const auto* srif : post::recommended(alone.summary.srif))
    bending = std::max(bending, std::abs(srif->K1)), in_plane = std::max(in_plane, std::abs(srif->membrane->N[0]));
  REQUIRE(in_plane > 0);
  for (std::size_t i = 0; i < one.srif.size(); ++i) {
    const auto &a = one.srif[i], &b = alone.summary.srif[i];
    CHECK(std::abs(a.K1 - b.K1) < 1e-6 * bending);
    CHECK(std::abs(a.K2 - b.K2) < 1e-6 * bending);
    CHECK(a.errors[0].value_or(0) == Approx(b.errors[0].value_or(0)).epsilon(1e-4).margin(1e-6 * bending));
    REQUIRE(a.membrane.has_value() == b.membrane.has_value());
    if (a.membrane) CHECK(std::abs(a.membrane->N[0] - b.membrane->N[0]) < 1e-6 * in_plane);
    CHECK(one.faces[i].utilisation.value_or(0) ==
          Approx(alone.summary.faces[i].utilisation.value_or(0)).epsilon(1e-5).margin(1e-12));
  }
  const auto &probes = table_of(all, "probes"), &own = table_of(alone, "probes");
  for (const std::string name : {"w", "u", "v"})
    CHECK(number(probes.rows.at(number_of_case - 1)[probes.column(name)]) ==
          Approx(number(own.rows.at(0)[own.column(name)])).epsilon(1e-6));
  CHECK(one.reactions->balance.supports[0].force ==
        Approx(alone.summary.reactions->balance.supports[0].force).epsilon(1e-6));
  CHECK(one.reactions->balance.residual < 1e-6);
  for (const std::size_t i : {0, 1, 2})
    CHECK((one.membrane->reactions.at(i).force - alone.summary.membrane->reactions.at(i).force).norm() <
          1e-6 * alone.summary.membrane->reactions.at(i).force.norm());
  const auto energy = [&](const std::string& name) {
    return std::ranges::find(alone.summary.energy, name, &std::pair<std::string, double>::first)->second;
  };
  CHECK(one.strain_energy == Approx(energy("strain")).epsilon(1e-6));
  CHECK(one.external_work == Approx(energy("external_work")).epsilon(1e-6));
}

}  // namespace

TEST_CASE(
    "load cases: with large deflections each is what it is alone, and a combination what its loads are together") {
  const auto text = no_load + load_case("dead", {scaled(press, "2")}) +
                    load_case("drag", {scaled(drag, "4"), scaled(third, "-0.3")}) +
                    "[[combination]]\nname = \"all\"\nof = { dead = 1.5, drag = -2 }\n" +
                    "[[combination]]\nname = \"nothing\"\nof = { dead = 0, drag = 0 }\n";
  const auto all = run_curved(text);
  const auto& found = all.summary.load_cases;
  REQUIRE(found.size() == 4);
  const std::string twice = "kind = \"body_force\"\nvector = [-8, -0.2]\n";
  const auto dead = run_curved(no_load + "[[load]]\n" + scaled(press, "2"));
  compare_curved(found[0], all, 1, dead);
  compare_curved(found[2], all, 3,
                 run_curved(no_load + "[[load]]\n" + scaled(press, "3") + "[[load]]\n" + twice + "[[load]]\n" +
                            scaled(third, "0.6")));
  const auto& probes = table_of(all, "probes");
  const auto w = [&](std::size_t row) { return number(probes.rows.at(row)[probes.column("w")]); };
  CHECK(std::abs(w(2) - (1.5 * w(0) - 2 * w(1))) > 0.01 * std::abs(w(2)));  // it is no sum
  CHECK(w(3) == 0);
  CHECK(all.summary.load_steps.columns.back() == "case");
  CHECK(table_of(all, "load_steps").rows.size() == all.summary.load_steps.rows.size());
  CHECK(all.summary.analysis.method == "newton");
  CHECK_FALSE(all.summary.linear_theory_off);
  CHECK(all.in_memory.frames.size() == 4);
  CHECK(all.summary.outcome == "done");
  CHECK(nlohmann::json::parse(all.in_memory.summary).at("load_cases").at(2).at("superposed") == false);
}

TEST_CASE("load cases: reactions along edges follow the loads, and are absent where nobody asks for them") {
  const std::vector<std::string> soft{"section.thickness=0.05",
                                      "support=[{kind=\"simply_supported\",edges=[\"left\",\"right\",\"bottom\"]}]",
                                      "output.errors=false"};
  auto along = soft;
  along.push_back("output.edge_reactions=5");
  const auto text = with_line(cases_of_three, 9, "spacing = 0.1");
  const auto found = run(text, "galerkin", along);
  const auto& edges = table_of(found, "edge_reactions");
  const auto& corners = table_of(found, "corner_forces");
  CHECK(edges.columns.back() == "case");
  REQUIRE(edges.rows.size() == 4 * 3 * 5);  // of cases and a combination, edges, pieces
  REQUIRE(corners.rows.size() == 4 * 4);
  const auto combined = [&](const post::Table& table, const char* column) {
    const auto value = [&, each = table.rows.size() / 4](std::size_t of, std::size_t row) {
      return number(table.rows[of * each + row][table.column(column)]);
    };
    for (std::size_t row = 0; row < table.rows.size() / 4; ++row)
      CHECK(value(3, row) ==
            Approx(1.35 * value(0, row) - 2 * value(1, row) + 1.5 * value(2, row)).epsilon(1e-6).margin(1e-7));
  };
  combined(edges, "force_per_length"), combined(edges, "kirchhoff_force"), combined(corners, "force");
  for (const auto& one : found.summary.load_cases) CHECK(one.reactions.value().corners.size() == 4);
  const auto json = nlohmann::json::parse(post::to_json(found.summary));
  const auto& reactions = json["load_cases"][0]["reactions"];
  CHECK(reactions["corner_forces"].size() == 4);
  REQUIRE(reactions["edge_reactions"].size() == 3 * 3);  // edges, quantities
  double most = 0;
  for (std::size_t row = 0; row < 3 * 5; ++row)
    if (edges.rows[row][edges.column("support")] == post::Cell("bottom"))
      most = std::max(most, std::abs(number(edges.rows[row][edges.column("kirchhoff_force")])));
  CHECK(reactions["edge_reactions"][0]["support"] == "bottom");
  CHECK(reactions["edge_reactions"][0]["quantity"] == "kirchhoff_force");
  CHECK(std::abs(reactions["edge_reactions"][0]["value"].get<double>()) == Approx(most));
  CHECK(std::ranges::none_of(found.summary.warnings, [](const auto& one) { return one.starts_with("corner forces"); }));
  const auto bonds = run(text, "ordinary", along);
  CHECK(std::ranges::count_if(bonds.summary.warnings,
                              [](const auto& one) { return one.starts_with("corner forces"); }) == 1);
  CHECK_THROWS_AS(table_of(run(text, "galerkin", soft), "edge_reactions"), std::out_of_range);
}
