#include "cases/input/validation.hpp"

#include <set>

#include "plate/model/problem.hpp"
#include "tests/catch.hpp"

namespace {

std::multiset<std::string> keys_of_errors(const plate::Problem& problem) {
  std::multiset<std::string> result;
  for (const auto& error : cases::errors_in_section(problem)) result.insert(error.key);
  return result;
}

}  // namespace

TEST_CASE("section faults: sections that change about a tip") {
  plate::Problem problem;
  problem.outline = geometry::rectangle(-1, -1, 1, 1);
  problem.cracks = {{{-0.3, 0}, {0.3, 0}}};
  problem.discretization.spacing = 0.02;
  problem.section = {1000, 0.3, 0.1, 5.0 / 6, 0};
  CHECK(keys_of_errors(problem).empty());
  auto directed = problem;
  directed.section.orthotropic = {1000, 100, 0.3, 50, 50, 50, 0};
  CHECK(keys_of_errors(directed).empty());
  auto varied = problem;
  varied.section.regions.push_back({geometry::Circle{{0.3, 0}, 0.2, ""}, 0.2, {}, {}, {}});
  CHECK(keys_of_errors(varied).empty());
  varied.section.regions.push_back({geometry::Circle{{-0.3, 0}, 0.1, ""}, 0.2, {}, {}, {}});
  CHECK(keys_of_errors(varied) == std::multiset<std::string>{"section.regions"});
  varied.section.young_factor = plate::Formula("1 + x");
  CHECK(keys_of_errors(varied) == std::multiset<std::string>{"section.young_factor"});
}
