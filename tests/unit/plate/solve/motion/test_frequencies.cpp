// Plates that processes share; closed forms, rigid motions and dense eigenvalues:
// tests/verification/test_frequencies.cpp
#include "plate/solve/motion/frequencies.hpp"

#include <mutex>

#include "plate/bonds/ordinary_plate.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/model/problem.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

using namespace plate;

namespace {

Problem problem_of(const geometry::Outline& outline, std::vector<Support> supports) {
  Problem problem;
  problem.outline = outline;
  problem.section = {1000, 0.3, 0.05, 5.0 / 6, 2};
  problem.supports = std::move(supports);
  problem.loads = {Load{}};
  problem.discretization.spacing = 0.04;
  problem.discretization.formulation = &ordinary;
  return problem;
}

FrequencySolution solved(const Problem& problem, std::size_t modes, const Communicator& all) {
  const auto plate = discretise(problem, all).plate;
  FrequencyOptions options;
  options.modes = modes, options.tolerance = 1e-7;
  options.shift = shift_of(problem.section, 1);
  const auto inverse = plate->held() ? plate->preconditioner(Preconditioning::two_level).inverse : nullptr;
  options.preconditioner = inverse.get();
  return frequencies(*plate, plate->constraints(), plate->mass(), options);
}

/// Compares several processes with one; `rigid` motions without resistance, of which rounding is left. Returns the
/// modes of the ordinary program.
FrequencySolution check(const Problem& problem, std::size_t modes, std::size_t rigid, const std::vector<int>& counts) {
  const auto whole = solved(problem, modes, single_process());
  const double first = whole.modes[rigid].frequency;
  for (const int processes : counts)
    thread_ranks::run(processes, [&](const Communicator& all) {
      const auto found = solved(problem, modes, all);
      static std::mutex one_by_one;
      const std::lock_guard guard(one_by_one);
      REQUIRE(found.modes.size() == modes);
      for (std::size_t i = 0; i < modes; ++i) {
        const auto& [frequency, residual, shape] =
            std::tie(found.modes[i].frequency, found.modes[i].residual, found.modes[i].shape);
        CAPTURE(processes, i, frequency, frequency / whole.modes[i].frequency - 1, residual);
        if (i < rigid)
          CHECK(frequency < 1e-4 * first);
        else
          CHECK(frequency == Approx(whole.modes[i].frequency).epsilon(1e-10));
        CHECK(shape.row(0).cwiseAbs().maxCoeff() <= 1);
      }
    });
  return whole;
}

}  // namespace

TEST_CASE("a plate in parts: frequencies of a cracked plate") {
  using enum SupportKind;
  auto problem = problem_of(geometry::rectangle(0, 0, 1.6, 1.2),
                            {{clamped, {"left"}, {}}, {simply_supported, {"top"}, {}}, {symmetry, {"bottom"}, {}}});
  problem.cracks = {{{0.5, 0.3}, {0.9, 0.71}}};
  check(problem, 4, 0, {1, 2});
}

TEST_CASE("a plate in parts: frequencies of a free square, three of rigid motions and its double ones") {
  const auto problem = problem_of(geometry::rectangle(0, 0, 1.28, 1.28), {});
  const auto modes = check(problem, 8, 3, {2}).modes;
  CHECK(modes[6].frequency == Approx(modes[7].frequency).epsilon(1e-9));
}

TEST_CASE("a plate in parts: frequencies of two pieces") {
  auto problem = problem_of(geometry::rectangle(0, 0, 0.6, 1.28), {{SupportKind::clamped, {"bottom"}, {}}});
  problem.cracks = {{{-0.1, 0.61}, {0.7, 0.74}}};
  check(problem, 4, 3, {2});
}
