#include "plate/model/support_validation.hpp"

#include "plate/model/problem.hpp"
#include "tests/catch.hpp"

using namespace plate;

TEST_CASE("springs have one place, a stiffness, and something that supports leave to them") {
  Problem problem;
  problem.outline = geometry::rectangle(0, 0, 1, 1);
  problem.supports = {{SupportKind::simply_supported_hard, {"left"}, {}}, {SupportKind::symmetry, {"top"}, {}}};
  const auto count_of_errors = [&](const Spring& spring) {
    problem.springs = {spring};
    return errors_in_springs(problem).size();
  };
  CHECK(count_of_errors({}) == 1);  // nowhere, and nothing: in one sentence
  CHECK(count_of_errors({1, 0, 0, 0, {"right"}, {}, {}}) == 0);
  CHECK(count_of_errors({1, 0, 0, 0, {"right"}, {{0, 0}, {1, 1}}, {}}) == 1);
  CHECK(count_of_errors({1, 1, 1, 0, {"left"}, {}, {}}) == 1);  // w and psi_s
  CHECK(count_of_errors({1, 1, 1, 0, {"top"}, {}, {}}) == 1);   // psi_n
  CHECK(count_of_errors({1, 1, 1, 1, {}, {}, geometry::Point(0.5, 0.5)}) == 1);
  CHECK(count_of_errors({1, 1, 1, 1, {"right"}, {}, {}}) == 1);
  problem.springs.clear(), problem.foundations = {{1, 0, {}}};
  problem.discretization.boundary = EdgeMethod::surface_nodes;
  CHECK(errors_in_springs(problem).size() == 1);
}

TEST_CASE("stiffeners have one line, a stiffness, and no clamp") {
  Problem problem;
  problem.outline = geometry::rectangle(0, 0, 1, 1);
  problem.supports = {{SupportKind::clamped, {"left"}, {}}, {SupportKind::simply_supported, {"top"}, {}}};
  const auto count_of_errors = [&](double bending, double torsion, std::optional<double> shear,
                                   std::vector<std::string> edges) {
    problem.stiffeners = {
        {.bending = bending, .torsion = torsion, .shear = shear, .edges = std::move(edges), .along = {}}};
    return errors_in_springs(problem).size();
  };
  CHECK(count_of_errors(1, 0, 2, {"top"}) == 0);
  CHECK(count_of_errors(0, 1, {}, {"right"}) == 0);
  CHECK(count_of_errors(0, 1, 2, {"right"}) == 1);
  CHECK(count_of_errors(0, 0, {}, {}) == 1);
  CHECK(count_of_errors(1, 0, {}, {"left"}) == 1);
}
