// Tables that a quasi-static growth writes. They stay where it fails: the plate seen is that of the last equilibrium.

#include "cases/driver/run.hpp"
#include "cases/input/case_file.hpp"
#include "geometry/shape/crack_path.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/supports.hpp"
#include "post/files/hdf5/state_file.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "tests/catch.hpp"
#include "tests/unit/fracture/distributed_run.hpp"
#include "tests/unit/post/files/hdf5/look.hpp"
#include "tests/unit/post/small_run.hpp"

namespace {

namespace fs = std::filesystem;

/// The Galerkin plate, which refuses cracks longer than 0.75.
plate::Discretised narrow(const plate::Problem& problem, const plate::Communicator& all) {
  if (geometry::length(problem.cracks.front()) > 0.75)
    throw plate::Refused({{plate::Subject::cracks, 0, "too long; refine"}});
  return plate::galerkin.discretise(problem, all);
}

/// The Galerkin plate, twice.
std::size_t discretised_so_far = 0;
plate::Discretised twice(const plate::Problem& problem, const plate::Communicator& all) {
  if (++discretised_so_far > 2) throw plate::Refused({{plate::Subject::cracks, 0, "enough"}});
  return plate::galerkin.discretise(problem, all);
}

const plate::FormulationKind tired{"tired", "a plate that serves twice", plate::galerkin.lacks, twice};
const plate::FormulationKind fussy{"fussy", "a plate for short cracks", plate::galerkin.lacks, narrow};

/// A square with a crack from its left edge to the middle, bent by moments; it grows by 0.1 an advance.
cases::CaseFile edge_crack(const plate::FormulationKind& kind) {
  cases::CaseFile file;
  auto& c = file.content;
  c.section = {1000, 0.3, 0.2, 5.0 / 6, 1};
  c.outline = geometry::rectangle(0, 0, 1, 1);
  c.cracks = {{{0, 0.5}, {0.5, 0.5}}};
  c.discretization.spacing = 0.05;
  c.discretization.formulation = &kind;
  c.supports = {{plate::SupportKind::pinned, {}, {{0.9, 0.1}, {0.9, 0.9}, {0.1, 0.1}}}};
  c.loads = {plate::Load{plate::EdgeMoment{.edges = {"bottom", "top"}, .value = 1}}};
  auto& growth = c.growth.emplace();
  growth.fracture_energy = 1;
  growth.control = fracture::Growth::Control::equilibrium;
  growth.direction = fracture::Growth::Direction::straight;
  growth.increment = 2;
  c.output.vtk = c.output.hdf5 = false;
  return file;
}

}  // namespace

TEST_CASE("growth run: refused before it starts, it writes nothing") {
  const small_run::TemporaryFolder folder;
  auto file = edge_crack(fussy);
  file.content.cracks = {{{0, 0.5}, {0.8, 0.5}}};
  CHECK_THROWS_AS(cases::run(file, {folder / "results", true}), cases::CaseError);
  CHECK_FALSE(fs::exists(folder / "results"));
}

TEST_CASE("growth run: one row per advance in growth.csv, one per tip and advance in tips.csv") {
  const small_run::TemporaryFolder folder;
  auto file = edge_crack(plate::galerkin);
  file.content.growth->max_advances = 2;
  const auto summary = cases::run(file, {folder.path(), true});
  CHECK(summary.growth->outcome == "the largest number of advances");
  const auto growth = post::read_csv(folder / "growth.csv"), tips = post::read_csv(folder / "tips.csv");
  REQUIRE(growth.rows.size() == 3);
  REQUIRE(tips.rows.size() == 3);
  const auto at = [](const post::Table& table, std::size_t row, const char* name) {
    return std::get<double>(table.rows[row][table.column(name)]);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(at(growth, i, "advance") == double(i));
    CHECK(at(growth, i, "load_factor") == Approx(at(growth, i, "critical_load_factor")));
    CHECK(at(growth, i, "crack_length") == Approx(0.5 + 0.1 * double(i)));
    CHECK(at(tips, i, "x") == Approx(0.5 + 0.1 * double(i)));
    CHECK(at(tips, i, "moves") == (i < 2 ? 1 : 0));
  }
}

TEST_CASE("growth run: cracks that the points cannot follow are an error of the numbers, not a split plate") {
  const small_run::TemporaryFolder folder;
  CHECK_THROWS_WITH(cases::run(edge_crack(fussy), {folder.path(), true}),
                    "the plate cannot be discretised with its cracks as they have grown: too long; refine");
  const auto growth = post::read_csv(folder / "growth.csv");
  REQUIRE(growth.rows.size() >= 2);  // lengths 0.5, 0.6, 0.7
  for (const char* name : {"tips.csv", "history.csv", "srif.csv", "cracks.csv", "case.resolved.toml"})
    CHECK(fs::exists(folder / name));
  CHECK_THAT(small_run::text_of(folder / "summary.json"),
             Catch::Contains("\"outcome\": \"failed: the plate cannot be discretised"));
}

TEST_CASE("growth run: after a failure the last state is that of the last row, not of a trial") {
  const small_run::TemporaryFolder folder;
  const auto inclined = [&](const plate::FormulationKind& kind) {
    auto file = edge_crack(kind);
    auto& c = file.content;
    c.section.thickness = 0.4, c.discretization.spacing = 0.025;  // the direction is resolved
    c.cracks = {{{0, 0.3}, {0.5, 0.5}}};                          // the piece turns: it is tried, and then laid
    c.growth->direction = fracture::Growth::Direction::tangential_moment;
    c.output.vtk = c.output.hdf5 = true;
    return file;
  };
  discretised_so_far = 0;
  CHECK_THROWS_WITH(cases::run(inclined(tired), {folder / "failed", true}), Catch::Contains("enough"));
  REQUIRE(discretised_so_far == 3);
  auto first = inclined(plate::galerkin);
  first.content.growth->max_advances = 0;
  cases::run(first, {folder / "first", true});
  const auto failed = post::read_run(folder / "failed/state.h5"), expected = post::read_run(folder / "first/state.h5");
  REQUIRE(post::read_csv(folder / "failed/growth.csv").rows.size() == 1);
  REQUIRE(failed.states.size() == 1);
  REQUIRE(expected.states.size() == 1);
  CHECK(failed.positions == expected.positions);
  CHECK(failed.states.front() == expected.states.front());
  const auto moments = hdf5_look::Look(folder / "failed/state.h5").numbers("/frames/moments");
  CHECK(*std::ranges::max_element(moments) > 0);
  CHECK((moments == hdf5_look::Look(folder / "first/state.h5").numbers("/frames/moments")));
}

TEST_CASE("a plate in parts: a crack that grows at rest and turns") {
  auto file = shared_run::tall_plate();
  auto& c = file.content;
  c.outline = geometry::rectangle(0, 0, 1, 1.2);
  c.cracks = {{{0.45, 0.4}, {0.55, 0.63}}};  // across a border of blocks at 0.64
  c.analysis.tolerance = 1e-10, c.analysis.preconditioner = plate::Preconditioning::diagonal;
  c.growth->control = fracture::Growth::Control::equilibrium;
  c.growth->max_advances = 2;
  const auto one = shared_run::texts(file, 1);
  REQUIRE(one.contains("tips"));
  CHECK((shared_run::texts(file, 3) == one));
  for (const auto& [name, table] : shared_run::whole(file)) {
    CAPTURE(name);
    CHECK(shared_run::apart(table, one.at(name)) < 1e-6);
  }
}
