#include "plate/solve/factorised_plate.hpp"

#include "plate/bonds/ordinary_plate.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/problem.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

using namespace plate;

namespace {

/// Of the plate by 1, 2 and 5 processes: K of what the factor makes of the load is the load.
void require_inverse(const Problem& problem, bool tied) {
  for (const int processes : {1, 2, 5})
    thread_ranks::run(processes, [&](const Communicator& all) {
      const auto plate = discretise(problem, all).plate;
      if (tied && plate->constraints().ties().empty() && processes == 1) throw std::runtime_error("nothing is tied");
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
        if (at_dof(before, dof) != 0) throw std::runtime_error("what is held has moved");
    });
}

Problem problem_of(const FormulationKind& formulation, geometry::Outline outline, double spacing) {
  Problem problem;
  problem.outline = std::move(outline);
  problem.section = galerkin_plate::section;
  problem.discretization.spacing = spacing, problem.discretization.formulation = &formulation;
  problem.loads = {Load{Pressure{.value = 1}}};
  return problem;
}

}  // namespace

TEST_CASE("a factor of a Galerkin plate that processes share: it is the inverse, ties and held edges too") {
  auto problem = problem_of(galerkin, galerkin_plate::with_hole(), 0.05);
  problem.cracks = {{{0.1, 0.15}, {0.35, 0.3}}};
  // a round hole ties a rotation to the other
  problem.supports = {{SupportKind::simply_supported_hard, {"hole0"}, {}}, {SupportKind::clamped, {"left"}, {}}};
  require_inverse(problem, true);
}

TEST_CASE("a factor of a plate of bonds that processes share: it is the inverse, images and soil across a crack too") {
  // a strip of which every process has 16 rows
  auto problem = problem_of(ordinary, geometry::rectangle(0, 0, 0.1, 0.8), 0.01);
  problem.cracks = {{{0, 0.3}, {0.06, 0.34}}, {{0.035, 0.48}, {0.1, 0.48}}};
  problem.supports = {{SupportKind::simply_supported_hard, {"bottom"}, {}}, {SupportKind::clamped, {"left"}, {}}};
  problem.foundations.resize(1);
  problem.foundations[0].modulus = 1e4, problem.foundations[0].shear = 50;
  require_inverse(problem, true);
}
