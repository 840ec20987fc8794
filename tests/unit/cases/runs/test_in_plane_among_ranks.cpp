// Loads in the plane by several processes, as threads of one.
#include <mutex>
#include <set>

#include "cases/driver/run.hpp"
#include "post/files/results_in_memory.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

using namespace case_text;

namespace {

/// A strip in tension and bending, with an inclined crack.
const std::vector<std::string> one_load{
    "support=[{kind='simply_supported',edges=['bottom'],in_plane='normal'},{kind='simply_supported',edges=['top']},"
    "{kind='in_plane',points=[[0,-1]]}]",
    "geometry={outline={rectangle=[-0.5,-1,0.5,1]},cracks=[[[-0.25,-0.12],[0.25,0.17]]]}",
    "load=[{kind='edge_traction',edges=['top'],value=1,shear=0.2},{kind='body_force',vector=[0.3,0.2]},"
    "{kind='point_force',position=[0.3,0.3],vector=[0.2,0.1]},{kind='pressure',value=0.1}]",
    "section.thickness=0.2",
    "analysis={kind='static',method='cg',preconditioner='diagonal',tolerance=1e-10}",
    "srif={}",
    "output.probes={a=[0.3,0.2],b=[0,1]}"};

/// Settings of the strip under load cases, of which one does not act in the plane.
std::vector<std::string> with_cases() {
  auto result = one_load;
  result.insert(result.end(), {"-load",
                               "case=[{name='pull',load=[{kind='edge_traction',edges=['top'],value=1}]},"
                               "{name='press',load=[{kind='pressure',value=0.1}]}]",
                               "combination=[{name='both',of={pull=2,press=-1}}]"});
  return result;
}

/// Settings of the strip for another analysis, in coarse points.
std::vector<std::string> analysed(const std::string& analysis, bool bonds) {
  auto result = one_load;
  std::erase_if(result, [](const std::string& one) { return one.starts_with("analysis"); });
  result.push_back("analysis=" + analysis);
  result.emplace_back(bonds ? "discretization.formulation=ordinary" : "discretization.formulation=galerkin");
  result.emplace_back(bonds ? "discretization.spacing=0.0625" : "discretization.spacing=0.1");
  return result;
}

/// Settings of the strip for its modes under a pressure at its top, without what acts across it.
std::vector<std::string> with_modes(const std::string& analysis, bool bonds) {
  auto result = analysed(analysis, bonds);
  std::erase_if(result, [](const std::string& one) {
    return one.starts_with("load") || one.starts_with("srif") || one.starts_with("output");
  });
  result.insert(result.end(), {"load=[{kind='edge_traction',edges=['top'],value=-1}]", "section.density=1"});
  return result;
}

/// Position, u, v, Nxx, Nyy, Nxy of a vertex of the drawing.
using Drawn = std::array<double, 7>;

struct Found {
  std::map<std::string, std::string> tables;
  std::map<std::string, post::Table> numbers;
  std::vector<std::set<Drawn>> frames;
  std::vector<std::string> warnings;
  post::Table frequencies{{"frequency"}, {}};
  std::map<std::string, double> energies;
};

/// Nothing of modes, which have no fields in the plane.
std::set<Drawn> drawn(const post::ResultsInMemory::Fields& frame) {
  if (!frame.arrays.contains("displacement")) return {};
  const auto &x = frame.arrays.at("x").values, &u = frame.arrays.at("displacement").values,
             &N = frame.arrays.at("membrane_forces").values;
  std::set<Drawn> result;
  for (std::size_t k = 0; 2 * k < x.size(); ++k)
    result.insert({x[2 * k], x[2 * k + 1], u[2 * k], u[2 * k + 1], N[3 * k], N[3 * k + 1], N[3 * k + 2]});
  return result;
}

/// Tables and warnings of the first process, and what all draw.
Found found(const cases::CaseFile& file, int processes) {
  Found result;
  std::mutex one_by_one;
  const auto run = [&](const plate::Communicator& all) {
    post::ResultsInMemory own;
    const auto summary = cases::run(file, {{}, true, &own, false, &all});
    const std::lock_guard guard(one_by_one);
    result.frames.resize(own.frames.size());
    for (std::size_t i = 0; i < own.frames.size(); ++i) result.frames[i].merge(drawn(own.frames[i]));
    if (all.rank() > 0) return;
    result.warnings = summary.warnings;
    result.energies.insert(summary.energy.begin(), summary.energy.end());
    for (const auto& mode : summary.frequencies) result.frequencies.rows.push_back({mode.frequency});
    for (const auto& [name, table] : own.tables)
      result.tables[name] = post::csv_text(table), result.numbers[name] = table;
  };
  if (processes == 0)
    run(plate::single_process());
  else
    thread_ranks::run(processes, run);
  return result;
}

/// Largest difference of columns, relative to their largest value.
double apart(const post::Table& one, const post::Table& other, const std::vector<std::string>& columns) {
  double result = 0;
  REQUIRE(one.rows.size() == other.rows.size());
  for (const auto& column : columns) {
    const auto at = one.column(column);
    double largest = 0, difference = 0;
    for (std::size_t i = 0; i < one.rows.size(); ++i) {
      const auto *a = std::get_if<double>(&one.rows[i][at]), *b = std::get_if<double>(&other.rows[i][at]);
      CHECK((a == nullptr) == (b == nullptr));  // a method may find no N2
      if (a && b) largest = std::max(largest, std::abs(*a)), difference = std::max(difference, std::abs(*a - *b));
    }
    CHECK(largest > 0);
    UNSCOPED_INFO(column << ": " << difference / largest);
    result = std::max(result, difference / largest);
  }
  return result;
}

double apart(const Found& one, const Found& other, const char* table, const std::vector<std::string>& columns) {
  return apart(one.numbers.at(table), other.numbers.at(table), columns);
}

/// Several processes write the same bits as one.
void check_parts(const cases::CaseFile& file, const Found& one, const std::vector<int>& counts) {
  for (const int processes : counts) {
    INFO(processes << " processes");
    const auto many = found(file, processes);
    CHECK(many.tables == one.tables);
    CHECK(many.frames == one.frames);
    CHECK(many.warnings == one.warnings);
  }
}

}  // namespace

TEST_CASE("a plate in parts: loads in the plane beside bending, tables and fields of any number of processes") {
  const bool cases = GENERATE(false, true), bonds = GENERATE(false, true);
  auto settings = cases ? with_cases() : one_load;
  for (const char* one : {bonds ? "discretization.formulation=ordinary" : "discretization.formulation=galerkin",
                          bonds ? "discretization.spacing=0.03125" : "discretization.spacing=0.05"})
    settings.emplace_back(one);
  INFO((bonds ? "bonds" : "Galerkin") << (cases ? ", load cases" : ""));
  const auto file = read(plain, settings);
  const auto ordinary = found(file, 0), one = found(file, 1);
  CHECK(one.tables.size() == (cases ? 5 : 4));
  REQUIRE(one.frames.size() == (cases ? 3 : 1));
  CHECK(one.frames.back().size() > 600);
  check_parts(file, one, {2, 4});
  CHECK(apart(ordinary, one, "history", {"strain_energy", "external_work", "max_abs_w"}) < 1e-13);  // measured 1.2e-14
  CHECK(apart(ordinary, one, "probes", {"w", "u", "v"}) < 1e-11);                                   // measured 3.0e-13
  CHECK(apart(ordinary, one, "srif", {"K1", "N1", "N2"}) < 1e-10);                                  // measured 6.9e-12
  CHECK(apart(ordinary, one, "reactions", {"force"}) < 1e-12);                                      // measured 2.3e-14
}

TEST_CASE("a plate in parts: motion under loads in the plane, with small and with large deflections") {
  const bool nonlinear = GENERATE(false, true), bonds = GENERATE(false, true);
  const std::string more = nonlinear ? ",nonlinear=true" : "";
  auto settings = analysed("{kind='dynamic',method='central_difference',duration=0.1" + more + "}", bonds);
  settings.insert(settings.end(), {"section.density=1", "output.history_every=0.02"});
  INFO((bonds ? "bonds" : "Galerkin") << more);
  const auto file = read(plain, settings);
  const auto ordinary = found(file, 0), one = found(file, 1);
  REQUIRE(one.numbers.at("history").rows.size() == 6);
  check_parts(file, one, bonds ? std::vector{2} : std::vector{2, 3});  // of bonds too few rows for 3
  CHECK(apart(ordinary, one, "history", {"strain_energy", "kinetic_energy", "external_work", "max_abs_w"}) < 1e-11);
  CHECK(apart(ordinary, one, "probes", {"w", "u", "v"}) < 1e-11);
}

TEST_CASE("a plate in parts: frequencies under loads in the plane and buckling") {
  const bool bonds = GENERATE(false, true);
  INFO((bonds ? "bonds" : "Galerkin"));
  const auto vibrating = read(plain, with_modes("{kind='frequencies',modes=3,tolerance=1e-8}", bonds)),
             buckling = read(plain, with_modes("{kind='buckling',modes=3,tolerance=1e-8}", bonds));
  const auto frequencies = found(vibrating, 0), factors = found(buckling, 0);
  REQUIRE(frequencies.frequencies.rows.size() == 3);
  REQUIRE(factors.numbers.at("buckling").rows.size() == 3);
  for (const int processes : {1, 2}) {
    INFO(processes << " processes");
    CHECK(apart(frequencies.frequencies, found(vibrating, processes).frequencies, {"frequency"}) < 1e-11);
    const auto many = found(buckling, processes);
    CHECK(apart(factors.numbers.at("buckling"), many.numbers.at("buckling"), {"factor"}) < 1e-11);  // by MPI 3e-12
    CHECK(many.warnings == factors.warnings);
  }
}

TEST_CASE("a plate in parts: large deflections at rest, of bonds beside constant loads") {
  const bool bonds = GENERATE(false, true);
  INFO((bonds ? "bonds" : "Galerkin"));
  auto settings = analysed("{kind='static',nonlinear=true,tolerance=1e-10}", bonds);
  settings.emplace_back(
      "support=[{kind='simply_supported',edges=['bottom'],in_plane='fixed'},{kind='simply_supported',edges=['top']}]");
  if (bonds)
    settings.emplace_back(
        "load=[{kind='edge_traction',edges=['top'],value=1,shear=0.2},{kind='pressure',value=0.1,constant=true}]");
  const auto file = read(plain, settings);
  const auto ordinary = found(file, 0);
  for (const int processes : {1, 2}) {
    INFO(processes << " processes");
    const auto many = found(file, processes);
    CHECK(many.numbers.at("load_steps").rows.size() == ordinary.numbers.at("load_steps").rows.size());
    CHECK(many.warnings == ordinary.warnings);
    CHECK(apart(ordinary, many, "history", {"strain_energy", "external_work", "max_abs_w"}) < 1e-9);
    CHECK(apart(ordinary, many, "probes", {"w", "u", "v"}) < 1e-9);
  }
}

TEST_CASE("a plate in parts: a path by arc length over limit points, beside constant loads") {
  const auto file =
      read(plain,
           {"section={young=1.0,poisson=0.0,thickness=0.01,thermal_expansion=1.0}",
            "geometry={outline={rectangle=[0.0,0.0,1.0,0.2]}}", "discretization={spacing=0.05,formulation='galerkin'}",
            "support=[{kind='simply_supported',edges=['left','right'],in_plane='normal'},"
            "{kind='symmetry',edges=['bottom','top'],in_plane='normal'}]",
            "load=[{kind='temperature',mean=2.0561675835602828e-4,constant=true},"
            "{kind='pressure',value=2.4352272758500609e-8,constant=true},{kind='pressure',value=-1.2e-7}]",
            "analysis={kind='static',nonlinear=true,control='arc_length',tolerance=1e-10}"});
  const auto ordinary = found(file, 0);
  const auto& steps = ordinary.numbers.at("load_steps");
  std::set<double> modes;
  for (const auto& row : steps.rows) modes.insert(std::get<double>(row[steps.column("unstable_modes")]));
  REQUIRE(modes == std::set{0.0, 1.0});
  for (const int processes : {1, 3}) {
    INFO(processes << " processes");
    const auto many = found(file, processes);
    CHECK(many.warnings == ordinary.warnings);
    CHECK(apart(steps, many.numbers.at("load_steps"),
                {"factor", "largest_deflection", "strain_energy", "arc_length", "deflection", "unstable_modes"}) <
          1e-9);
    CHECK(apart(ordinary, many, "history", {"strain_energy", "external_work", "max_abs_w"}) < 1e-9);
  }
}

TEST_CASE("a plate in parts: axial forces of stiffeners in buckling, frequencies and large deflections in motion") {
  const std::string ribs =
      "stiffener=[{along=[[-0.42,-0.7],[0.35,0.8]],bending=0.05,axial=30.0,mass=0.1},"
      "{edges=['left'],bending=0.05,axial=20.0}]";
  auto moving = analysed("{kind='dynamic',method='central_difference',duration=0.1,nonlinear=true}", false),
       buckling = with_modes("{kind='buckling',modes=3,tolerance=1e-8}", false),
       vibrating = with_modes("{kind='frequencies',modes=3,tolerance=1e-8}", false);
  moving.insert(moving.end(), {ribs, "section.density=1", "output.history_every=0.02"});
  buckling.push_back(ribs), vibrating.push_back(ribs);
  const auto in_motion = read(plain, moving), pressed = read(plain, buckling), modes = read(plain, vibrating);
  const auto motion = found(in_motion, 0), factors = found(pressed, 0), frequencies = found(modes, 0);
  for (const int processes : {1, 3}) {
    INFO(processes << " processes");
    CHECK(apart(motion, found(in_motion, processes), "history", {"strain_energy", "kinetic_energy", "max_abs_w"}) <
          1e-11);
    CHECK(apart(factors, found(pressed, processes), "buckling", {"factor"}) < 1e-11);
    CHECK(apart(frequencies.frequencies, found(modes, processes).frequencies, {"frequency"}) < 1e-11);
  }
}

TEST_CASE("a plate in parts: bending and stretching coupled by plies or stiffeners, at rest and in motion") {
  const std::string
      rib = "stiffener=[{along=[[-0.42,-0.7],[0.35,0.8]],bending=0.05,axial=30.0,eccentricity=0.15}]",
      ply = "thickness=0.1,E1=1000.0,E2=300.0,nu12=0.25,G12=200.0,G13=200.0,G23=150.0,alpha1=1e-4,alpha2=3e-4",
      plies = "section={plies=[{angle=30.0," + ply + "},{angle=-60.0," + ply + "}]}";
  const std::string heat = "{kind='temperature',mean=1.0,value=5.0}", at_rest = "{kind='static',tolerance=1e-10}";
  auto ribbed = analysed(at_rest, false), plied = ribbed, cases = ribbed,
       moving = analysed("{kind='dynamic',method='central_difference',duration=0.1}", false);
  ribbed.push_back(rib), moving.insert(moving.end(), {rib, "section.density=1", "output.history_every=0.02"});
  for (auto* settings : {&plied, &cases}) {
    std::erase_if(*settings,
                  [](const std::string& one) { return one.starts_with("s") && !one.starts_with("support"); });
    settings->push_back(plies);
  }
  plied.push_back("load=[{kind='edge_traction',edges=['top'],value=1}," + heat + "]");
  cases.insert(cases.end(), {"-load",
                             "case=[{name='pull',load=[{kind='edge_traction',edges=['top'],value=1}]},"
                             "{name='heat',load=[" +
                                 heat + "]}]"});
  for (const auto& settings : {ribbed, plied, cases, moving}) {
    const auto file = read(plain, settings);
    const auto ordinary = found(file, 0);
    for (const int processes : {1, 3}) {
      INFO(processes << " processes, " << settings.back());
      const auto many = found(file, processes);
      CHECK(many.warnings == ordinary.warnings);
      CHECK(apart(ordinary, many, "history", {"strain_energy", "external_work", "max_abs_w"}) < 1e-9);
      CHECK(apart(ordinary, many, "probes", {"w", "u", "v"}) < 1e-9);
    }
  }
}

TEST_CASE("a plate in parts: growth under loads in the plane, at rest and in motion") {
  const std::vector<std::string> strip{
      "geometry={outline={rectangle=[-0.5,-0.7,0.5,0.7]},cracks=[[[-0.1,0.0],[0.1,0.0]]]}",
      "support=[{kind='simply_supported',edges=['bottom'],in_plane='normal'},{kind='simply_supported',edges=['top']},"
      "{kind='in_plane',points=[[0,-0.7]]}]",
      "load=[{kind='edge_traction',edges=['top'],value=1},{kind='pressure',value=0.002}]"};
  auto at_rest = strip, moving = strip;
  at_rest.insert(at_rest.end(),
                 {"discretization={spacing=0.03,formulation='galerkin'}", "analysis={kind='static',tolerance=1e-8}",
                  "growth={fracture_energy=1.0,control='equilibrium',max_advances=1}"});
  moving.insert(moving.end(), {"discretization={spacing=0.03,formulation='ordinary'}", "section.density=1",
                               "analysis={kind='dynamic',duration=0.05}", "growth={fracture_energy=0.001}"});
  for (const bool moves : {false, true}) {
    const auto file = read(plain, moves ? moving : at_rest);
    const auto ordinary = found(file, 0), many = found(file, 2);
    REQUIRE(ordinary.numbers.at("tips").rows.size() > 2);
    CHECK(many.warnings == ordinary.warnings);
    CHECK(many.tables.at("cracks") == ordinary.tables.at("cracks"));
    CHECK(apart(ordinary, many, "growth", {"crack_length"}) < 1e-9);
    CHECK(apart(ordinary, many, "tips", {moves ? "x" : "N1"}) < 1e-9);
    CHECK(apart(ordinary, many, "history", {"strain_energy", "external_work", "max_abs_w"}) < 1e-9);
    for (const auto& [name, energy] : ordinary.energies) CHECK(many.energies.at(name) == Approx(energy).epsilon(1e-6));
  }
}

TEST_CASE("a plate in parts: buckling and frequencies where a stiffener couples bending and stretching") {
  const std::string rib =
      "stiffener=[{along=[[-0.42,-0.7],[0.35,0.8]],bending=0.05,axial=30.0,eccentricity=0.15,mass=0.1}]";
  auto buckling = with_modes("{kind='buckling',modes=3,tolerance=1e-8}", false),
       vibrating = with_modes("{kind='frequencies',modes=3,tolerance=1e-8}", false);
  for (auto* settings : {&buckling, &vibrating}) {
    settings->push_back(rib);
    settings->emplace_back(
        "support=[{kind='simply_supported',edges=['bottom'],in_plane='fixed'},{kind='simply_supported',edges=['top']}"
        "]");
  }
  const auto pressed = read(plain, buckling), modes = read(plain, vibrating);
  const auto factors = found(pressed, 0), frequencies = found(modes, 0);
  REQUIRE(frequencies.frequencies.rows.size() == 3);
  for (const int processes : {1, 3}) {
    INFO(processes << " processes");
    const auto many = found(pressed, processes);
    CHECK(many.warnings == factors.warnings);
    CHECK(apart(factors, many, "buckling", {"factor"}) < 1e-10);
    CHECK(apart(frequencies.frequencies, found(modes, processes).frequencies, {"frequency"}) < 1e-10);
  }
}

namespace {

/// A strip that bends, with an oblique crack inside it and another one from its edge, whose faces touch. Nothing holds
/// it in its plane.
std::vector<std::string> with_touching_faces(bool bonds) {
  return {
      "geometry={outline={rectangle=[-0.5,-0.75,0.5,0.75]},cracks=[[[-0.21,-0.13],[0.19,0.12]],[[0.5,0.4],[0.25,0.33]]]"
      "}",
      "cracks={contact=true}",
      "section.thickness=0.2",
      "support=[{kind='simply_supported',edges=['bottom','top']}]",
      "load=[{kind='pressure',value=0.1},{kind='edge_moment',edges=['top'],value=0.02}]",
      "analysis={kind='static',tolerance=1e-11}",
      "srif={}",
      "output.probes={a=[0.3,0.2],b=[0,0.65]}",
      bonds ? "discretization={formulation='ordinary',spacing=0.0625}"
            : "discretization={formulation='galerkin',spacing=0.1,tip_spacing=0.03}"};
}

}  // namespace

TEST_CASE("a plate in parts: faces of cracks that touch, at rest, in load cases and with large deflections") {
  const bool bonds = GENERATE(false, true);
  auto one_state = with_touching_faces(bonds), cases = one_state, nonlinear = one_state;
  cases.insert(cases.end(), {"-load",
                             "support=[{kind='simply_supported',edges=['bottom'],in_plane='normal'},"
                             "{kind='simply_supported',edges=['top']},{kind='in_plane',points=[[0,-0.75]]}]",
                             "case=[{name='press',load=[{kind='edge_traction',edges=['top'],value=-1}]},"
                             "{name='bend',load=[{kind='pressure',value=0.1}]}]",
                             "combination=[{name='both',of={press=0.3,bend=-1}}]"});
  nonlinear.insert(nonlinear.end(), {"-srif", "analysis={kind='static',nonlinear=true,tolerance=1e-10}"});
  auto tried = std::vector{one_state, cases};
  if (!bonds) tried.push_back(nonlinear);  // of bonds 20 s
  for (const auto& settings : tried) {
    const auto file = read(plain, settings);
    const auto ordinary = found(file, 0);
    const int processes = bonds ? 2 : 3;
    INFO((bonds ? "bonds, " : "Galerkin, ") << processes << " processes, " << settings.back());
    const auto many = found(file, processes);
    if (!bonds) CHECK(many.warnings == ordinary.warnings);  // one process compares bonds with cells
    // measured 9.6e-14, 8.7e-14, 8.3e-13, 1.2e-11
    CHECK(apart(ordinary, many, "contact", {"x", "length", "opening_top", "pressure_bottom"}) < 1e-11);
    CHECK(apart(ordinary, many, "history", {"strain_energy", "external_work", "max_abs_w"}) < 1e-11);
    CHECK(apart(ordinary, many, "probes", {"w", "u", "v"}) < 1e-11);
    if (file.content.srif) CHECK(apart(ordinary, many, "srif", {"K1", "K2", "K3", "N1", "N2"}) < 1e-9);
  }
}

TEST_CASE("a plate in parts: cracks that grow at rest while their faces touch") {
  auto settings = with_touching_faces(false);
  settings.insert(settings.end(),
                  {"-output.probes", "discretization={formulation='galerkin',spacing=0.05,tip_spacing=0.02}",
                   "growth={fracture_energy=1.0,control='equilibrium',max_advances=1,direction='straight'}"});
  const auto file = read(plain, settings);
  const auto ordinary = found(file, 0), many = found(file, 2);
  REQUIRE(ordinary.numbers.at("growth").rows.size() > 1);
  CHECK(many.warnings == ordinary.warnings);
  CHECK(apart(ordinary, many, "growth", {"crack_length", "load_factor"}) < 1e-10);  // measured 8e-14
  CHECK(apart(ordinary, many, "tips", {"K1", "N1"}) < 1e-9);                        // measured 1e-13
}

TEST_CASE("a plate in parts: faces of cracks that touch in motion") {
  const auto scene =
      GENERATE(as<std::string>(), "Galerkin", "Galerkin, large deflections", "Galerkin, from rest", "bonds");
  const bool bonds = scene == "bonds", from_rest = scene == "Galerkin, from rest";
  auto settings = with_touching_faces(bonds);
  settings.insert(settings.end(), {"section.density=1", "output.history_every=0.02", "load[0].value=3",
                                   "analysis={kind='dynamic',duration=0.1" +
                                       std::string(from_rest                                ? ",start='equilibrium'}"
                                                   : scene == "Galerkin, large deflections" ? ",nonlinear=true}"
                                                                                            : "}")});
  // factors of bonds whose faces are pressed add up shares of ranks, and differ by rounding
  settings.emplace_back(bonds ? "-srif" : "geometry.cracks=[[[-0.21,-0.13],[0.19,0.12]],[[-0.1,0.2],[0.1,-0.2]]]");
  if (from_rest) settings.emplace_back("load[0].history=[[0,1],[0.02,0]]");
  INFO(scene);
  const auto file = read(plain, settings);
  const auto ordinary = found(file, 0), one = found(file, 1);
  std::vector compared{one};
  if (from_rest)  // whose factor is rounded
    compared.push_back(found(file, 3));
  else
    check_parts(file, one, bonds ? std::vector{2} : std::vector{2, 3, 4});
  for (const auto& other : compared) {
    // measured 3.7e-14, 1.1e-14, 0
    CHECK(apart(ordinary, other, "contact", {"x", "opening_top", "pressure_bottom"}) < 1e-12);
    CHECK(apart(ordinary, other, "history", {"strain_energy", "kinetic_energy", "external_work", "max_abs_w"}) < 1e-12);
    if (!from_rest) CHECK(apart(ordinary, other, "history", {"contact_energy"}) < 1e-10);
    if (!bonds) CHECK(apart(ordinary, other, "srif", {"K1", "K2", "K3", "N1", "N2"}) < 1e-10);
  }
}

TEST_CASE("a plate in parts: faces that touch on soil that lifts off, and beside ribs on one side") {
  const auto scene = GENERATE(as<std::string>(), "soil", "rib on soil");
  auto settings = with_touching_faces(false);
  settings.insert(settings.end(),
                  {"load[0].value=0.05", "load[2]={kind='point_force',position=[0.3,-0.3],value=-0.1}",
                   "analysis={kind='static',tolerance=1e-10}", "foundation=[{modulus=5,lifts_off=true}]"});
  if (scene == "rib on soil")
    settings.emplace_back("stiffener=[{along=[[-0.42,-0.7],[-0.35,0.7]],bending=0.05,axial=30.0,eccentricity=0.15}]");
  const auto file = read(plain, settings);
  const auto ordinary = found(file, 0), many = found(file, 3);
  INFO(scene);
  CHECK(many.warnings == ordinary.warnings);
  // measured 1.3e-14, 2.1e-14, 8.6e-14, 2.4e-11
  CHECK(apart(ordinary, many, "contact", {"x", "opening_top", "pressure_bottom"}) < 1e-11);
  CHECK(apart(ordinary, many, "history", {"strain_energy", "external_work", "max_abs_w"}) < 1e-11);
  CHECK(apart(ordinary, many, "probes", {"w", "u", "v"}) < 1e-11);
  CHECK(apart(ordinary, many, "srif", {"K1", "K2", "N1"}) < 1e-9);
}
