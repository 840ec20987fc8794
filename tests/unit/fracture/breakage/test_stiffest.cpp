#include "fracture/breakage/damaged_plate.hpp"

#include <mutex>

#include "plate/bonds/ordinary_plate.hpp"
#include "plate/bonds/rows/lattice_operator.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/problem.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

TEST_CASE("stiffest: all processes go by the same full family") {
  plate::Problem problem;
  problem.outline.outer.vertices = {{0, 0}, {1, 0}, {1, 0.66}, {0.08, 0.66}, {0.08, 1.9}, {0, 1.9}};  // narrow above
  for (const char* name : {"a", "b", "c", "d", "e", "f"}) problem.outline.outer.edge_names.push_back(name);
  problem.section = {1000, 0.3, 0.05, 5.0 / 6, 2};
  problem.loads = {plate::Load{}};
  problem.discretization.spacing = 0.02;
  problem.discretization.formulation = &plate::ordinary;
  const auto found = [&](const plate::Communicator& all) {
    const auto plate = plate::discretise(problem, all).plate;
    const auto result = fracture::stiffest(*plate->breaking(), plate->boundary());
    double sum = 0;  // of the bonds of a full family
    for (const auto& bond : result.bonds)
      if (std::isfinite(bond.B)) sum += bond.B;
    return std::array{result.bending, result.shear, sum};
  };
  const auto whole = found(plate::single_process());
  CHECK(whole[0] > 0);
  CHECK(whole[1] > 0);
  thread_ranks::run(5, [&](const plate::Communicator& all) {
    const auto own = found(all);
    static std::mutex one_by_one;
    const std::lock_guard guard(one_by_one);
    CHECK(own[0] == whole[0]);
    CHECK(own[1] == whole[1]);
    CHECK(own[2] == Approx(whole[2]).epsilon(1e-12));  // in another order
  });
}
