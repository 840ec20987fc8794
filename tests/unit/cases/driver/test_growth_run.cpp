// What a quasi-static growth writes.

#include "cases/driver/run.hpp"
#include "cases/input/case_file.hpp"
#include "geometry/shape/crack_path.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/supports.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

namespace {

namespace fs = std::filesystem;

/// The Galerkin plate, which refuses cracks longer than 0.75.
plate::Discretised narrow(const plate::Problem& problem, const plate::Communicator& all) {
  if (geometry::length(problem.cracks.front()) > 0.75)
    throw plate::Refused({{plate::Subject::cracks, 0, "too long; refine"}});
  return plate::galerkin.discretise(problem, all);
}

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
