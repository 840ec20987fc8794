#include "cases/input/validation.hpp"

#include <set>

#include "plate/model/problem.hpp"
#include "post/factors/srif.hpp"
#include "tests/catch.hpp"

namespace {

std::multiset<std::string> keys(const plate::Problem& problem, bool grows, const post::SrifOptions& srif) {
  std::multiset<std::string> result;
  for (const auto& fault : fracture::faults_of_section(problem, grows, srif)) result.insert(fault.key);
  return result;
}

}  // namespace

TEST_CASE("section faults: growth, accuracies and toughness are of one isotropic section") {
  plate::Problem problem;
  problem.outline = geometry::rectangle(-1, -1, 1, 1);
  problem.cracks = {{{-0.3, 0}, {0.3, 0}}};
  problem.discretization.spacing = 0.02;
  problem.section = {1000, 0.3, 0.1, 5.0 / 6, 0};
  post::SrifOptions srif;
  srif.accuracy = 0.01, srif.toughness = 1;
  CHECK(keys(problem, true, srif).empty());
  auto directed = problem;
  directed.section.orthotropic = {1000, 100, 0.3, 50, 50, 50, 0};
  CHECK(keys(directed, true, srif) == std::multiset<std::string>{"growth", "srif.accuracy", "srif.toughness"});
  CHECK(keys(directed, false, {}).empty());
  auto varied = problem;
  varied.section.regions.push_back({geometry::Circle{{0.3, 0}, 0.2, ""}, 0.2, {}, {}, {}});
  CHECK(keys(varied, false, {}).empty());
  varied.section.regions.push_back({geometry::Circle{{-0.3, 0}, 0.1, ""}, 0.2, {}, {}, {}});
  CHECK(keys(varied, false, {}) == std::multiset<std::string>{"section.regions"});
  varied.section.young_factor = plate::Formula("1 + x");
  CHECK(keys(varied, false, {}) == std::multiset<std::string>{"section.young_factor"});
  CHECK(fracture::faults_of_section(varied, false, {}).empty());
}
