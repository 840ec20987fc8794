#include "plate/galerkin/shared/shared_factor.hpp"

#include <catch2/catch.hpp>

#include "plate/formulation/discretised.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/problem.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"
#include "tests/unit/plate/model/ranks/thread_ranks.hpp"

using namespace plate;

TEST_CASE("a factor of a Galerkin plate that processes share: it is the inverse, ties and held edges too") {
  Problem problem;
  problem.outline = galerkin_plate::with_hole();
  problem.section = galerkin_plate::section;
  problem.cracks = {{{0.1, 0.15}, {0.35, 0.3}}};
  // a round hole ties a rotation to the other
  problem.supports = {{SupportKind::simply_supported_hard, {"hole0"}, {}}, {SupportKind::clamped, {"left"}, {}}};
  problem.discretization.spacing = 0.05, problem.discretization.formulation = &galerkin;
  problem.loads.resize(1), problem.loads[0].value = 1;
  for (const int processes : {1, 2, 5})
    thread_ranks::run(processes, [&](const Ranks&) {
      const auto plate = discretise(problem).plate;
      if (plate->constraints().ties().empty() && processes == 1) throw std::runtime_error("nothing is tied");
      const auto factor = plate->factor();
      Forces residual = plate->total_load(), product;
      plate->constraints().fold(residual);
      State found;
      factor->apply(residual, found);
      const Forces before = found;
      plate->constraints().impose(found);
      plate->internal_force(found, product);
      plate->constraints().fold(product);
      const double largest = residual.cwiseAbs().maxCoeff();
      if (!((product + residual).cwiseAbs().maxCoeff() < 1e-8 * largest)) throw std::runtime_error("no inverse");
      for (const auto dof : plate->constraints().held())
        if (before(dof % 3, dof / 3) != 0) throw std::runtime_error("what is held has moved");
    });
}
