#include "plate/formulations.hpp"

#include "plate/bonds/ordinary_plate.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/problem.hpp"
#include "tests/catch.hpp"

using namespace plate;

TEST_CASE("usual solver: what UMFPACK takes with nodes on or beyond the edges, measured as peaks of whole runs") {
  Problem problem;
  problem.discretization.formulation = &ordinary;
  // points, bytes less 60e6 and 11e3 a point for all else
  for (const auto& [points, peak] :
       {std::pair{2500.0, 0.332e9}, std::pair{10000.0, 1.494e9}, std::pair{22500.0, 3.843e9}, std::pair{4e4, 6.6e9}})
    for (const auto method : {EdgeMethod::surface_nodes, EdgeMethod::fictitious_nodes}) {
      problem.discretization.boundary = method;
      const double bytes = usual_solver(problem, StaticMethod::cg, Preconditioning::automatic, points).bytes;
      const double ratio = bytes / (peak - 60e6 - 11e3 * points);
      CHECK(ratio > 1 / 1.25);  // measured: 0.94 to 1.18
      CHECK(ratio < 1.25);
    }
  problem.discretization.boundary = EdgeMethod::images;
  CHECK(usual_solver(problem, StaticMethod::direct, Preconditioning::automatic, 1e4).bytes < 0.6e9);
}

TEST_CASE("usual solver: a plate whose bending and stretching are coupled has the factor of both") {
  Problem problem;
  problem.discretization.formulation = &galerkin;
  const auto alone = usual_solver(problem, StaticMethod::direct, Preconditioning::automatic, 1e4);
  problem.stiffeners.emplace_back().axial = 1;
  CHECK(usual_solver(problem, StaticMethod::cg, Preconditioning::automatic, 1e6).method == StaticMethod::cg);
  problem.stiffeners[0].eccentricity = 0.1;
  const auto both = usual_solver(problem, StaticMethod::cg, Preconditioning::automatic, 1e4);
  CHECK(both.method == StaticMethod::direct);
  CHECK(both.words == "factor of the plate and its plane");
  CHECK(both.bytes > 2 * alone.bytes);
}
