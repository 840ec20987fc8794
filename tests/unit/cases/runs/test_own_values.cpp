#include "cases/runs/checkpoints.hpp"

#include <cmath>
#include <cstring>
#include <mutex>

#include "plate/bonds/ordinary_plate.hpp"
#include "plate/edges/surface_formulation.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/problem.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"
#include "tests/unit/post/small_run.hpp"

namespace {

/// Numbers by the places of the points.
plate::State some(const plate::Boundary& boundary, double factor) {
  plate::State state(3, Eigen::Index(boundary.cloud.size()));
  for (Eigen::Index k = 0; k < state.cols(); ++k) {
    const auto& u = boundary.lattice[std::size_t(k)];
    state.col(k) << factor * u.x(), u.y() / 3, u.x() / (1 + u.y());
  }
  return state;
}

}  // namespace

TEST_CASE("own values: what some processes write of their points others find again, bit for bit") {
  plate::Problem problem;
  problem.outline = geometry::rectangle(0, 0, 0.5, 1.2);
  problem.section = {1000, 0.3, 0.05, 5.0 / 6, 2};
  problem.loads = {plate::Load{}};
  problem.discretization.spacing = 0.01;
  problem.discretization.formulation = &plate::ordinary;
  SECTION("of bonds") {}
  SECTION("of a Galerkin plate, whose points need not have cells of their own") {
    problem.cracks = {{{0.11, 0.52}, {0.37, 0.81}}};
    problem.discretization.spacing = 0.05, problem.discretization.tip_spacing = 0.005;
    problem.discretization.formulation = &plate::galerkin;
  }
  const small_run::TemporaryFolder folder;
  std::vector<std::filesystem::path> files;
  for (int rank = 0; rank < 3; ++rank) files.push_back(folder / std::to_string(rank));
  thread_ranks::run(3, [&](const plate::Communicator& all) {
    const auto plate = plate::discretise(problem, all).plate;
    const auto one = some(plate->boundary(), 0.1), other = some(plate->boundary(), 7);
    const plate::State none(3, 0);
    const auto own = cases::own_values(plate->boundary(), {&one, &other, &none});
    post::write_cells(files[std::size_t(all.rank())], own);
  });
  for (const int processes : {1, 2, 5})
    thread_ranks::run(processes, [&](const plate::Communicator& all) {
      const auto plate = plate::discretise(problem, all).plate;
      const auto& boundary = plate->boundary();
      plate::State one, other, none;
      cases::put_values(boundary, files, {{&one}, {&other}, {&none}});
      bool same = true;
      std::size_t own = 0;
      const auto first = some(boundary, 0.1), second = some(boundary, 7);
      for (Eigen::Index k = 0; k < Eigen::Index(boundary.cloud.plate_points); ++k) {
        if (!boundary.owns(std::size_t(k))) continue;
        same = same && one.col(k) == first.col(k) && other.col(k) == second.col(k);
        ++own;
      }
      static std::mutex one_by_one;
      const std::lock_guard guard(one_by_one);
      CHECK(same);
      CHECK(own > 0);
      CHECK(none.cols() == 0);
    });
  files.pop_back();
  CHECK_THROWS_WITH(thread_ranks::run(1,
                                      [&](const plate::Communicator& all) {
                                        const auto plate = plate::discretise(problem, all).plate;
                                        plate::State one, other, none;
                                        cases::put_values(plate->boundary(), files, {{&one}, {&other}, {&none}});
                                      }),
                    Catch::Contains("does not have all points"));
}

TEST_CASE("own values: one process has all columns again, of fictitious and graded points too, bit for bit") {
  plate::Problem problem;
  problem.outline = geometry::rectangle(-1, -1, 1, 1);
  problem.section = {1000, 0.3, 0.4};
  problem.supports = {{plate::SupportKind::clamped, {"left", "right", "bottom", "top"}, {}}};
  problem.loads = {plate::Load{plate::Pressure{.value = 1}}};
  problem.discretization.spacing = 0.1;
  SECTION("with images") {
    problem.discretization.formulation = &plate::ordinary;
  }
  SECTION("with surface nodes") {
    problem.discretization.spacing = 0.25;
    problem.discretization.volume_correction = plate::VolumeCorrection::lattice_fitted;
    problem.discretization.formulation = &plate::bonds_with_surface_nodes;
  }
  SECTION("of a Galerkin plate with graded points") {
    problem.cracks = {{{-0.45, 0.1}, {0.35, 0.2}}};
    problem.discretization.tip_spacing = 0.01;
    problem.discretization.formulation = &plate::galerkin;
  }
  const auto plate = plate::discretise(problem).plate;
  plate::State state(3, Eigen::Index(plate->points())), none(3, 0);
  for (Eigen::Index i = 0; i < state.size(); ++i)
    state.data()[i] = i % 5 == 0 ? -0.0 : i % 7 == 0 ? NAN : i % 11 == 0 ? -INFINITY : 1 / (double(i) + 0.3);
  const small_run::TemporaryFolder folder;
  post::write_cells(folder / "points", cases::own_values(plate->boundary(), {&state, &none}));
  plate::State again;
  const auto complete = [](plate::State&) { FAIL("nothing is missing"); };
  cases::put_values(plate->boundary(), {folder / "points"}, {{&again, complete}, {&none, complete}});
  REQUIRE(again.cols() == state.cols());
  CHECK(std::memcmp(again.data(), state.data(), std::size_t(state.size()) * sizeof(double)) == 0);
  CHECK(none.cols() == 0);
}
