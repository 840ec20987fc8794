#include "plate/model/problem.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "plate/model/wording.hpp"

namespace plate {
namespace {

std::vector<std::string> names_of(const std::vector<LoadCase>& cases) {
  std::vector<std::string> names;
  for (const auto& one : cases) names.push_back(one.name);
  return names;
}

void check_names(const Problem& problem, std::vector<KeyError>& errors) {
  std::map<std::string, std::string> seen;  // name, key
  const auto look = [&](const std::string& name, const std::string& key) {
    if (name.empty()) return;  // complained about where it is read
    const auto [first, is_new] = seen.emplace(name, key);
    if (!is_new)
      errors.push_back({key + ".name", fmt::format("\"{}\" is the name of {} already", name, first->second)});
  };
  for (std::size_t i = 0; i < problem.load_cases.size(); ++i)
    look(problem.load_cases[i].name, fmt::format("case[{}]", i));
  for (std::size_t i = 0; i < problem.combinations.size(); ++i)
    look(problem.combinations[i].name, fmt::format("combination[{}]", i));
}

void check_combination(const Problem& problem, std::size_t i, std::vector<KeyError>& errors) {
  const auto& one = problem.combinations[i];
  const auto names = names_of(problem.load_cases);
  const auto key = fmt::format("combination[{}].of", i);
  if (one.of.empty()) errors.push_back({key, "names no load case: give { name = factor, ... }"});
  for (const auto& [name, factor] : one.of) {
    if (!names.empty() && std::ranges::find(names, name) == names.end())
      errors.push_back({key + "." + name, fmt::format("\"{}\" is no load case{}", name, did_you_mean(name, names))});
    if (!std::isfinite(factor)) errors.push_back({key + "." + name, "must be finite"});
  }
}

}  // namespace

std::vector<KeyError> errors_in_load_cases(const Problem& problem) {
  std::vector<KeyError> errors;
  check_names(problem, errors);
  for (std::size_t i = 0; i < problem.load_cases.size(); ++i)
    if (shared_loads(problem) == 0 && problem.load_cases[i].loads.empty())
      errors.push_back({fmt::format("case[{}]", i), "nothing loads the plate in it: give it a [[case.load]]"});
  for (std::size_t i = 0; i < problem.combinations.size(); ++i) check_combination(problem, i, errors);
  if (!problem.combinations.empty() && problem.load_cases.empty())
    errors.push_back({"combination", "there is no [[case]] that could be combined"});
  if (!problem.combinations.empty() && !problem.load_cases.empty() && shared_loads(problem) > 0)
    errors.push_back({"combination",
                      "every load case has the loads of [[load]], and a sum of them would count these as often as its "
                      "factors say: give them to a [[case]] of their own"});
  return errors;
}

void join_loads(Problem& problem) {
  for (const auto& one : problem.load_cases)
    problem.loads.insert(problem.loads.end(), one.loads.begin(), one.loads.end());
}

std::optional<std::size_t> resolve_weights(Problem& problem) {
  const auto& section = problem.section;
  for (std::size_t i = 0; i < problem.loads.size(); ++i) {
    auto* pressure = problem.loads[i].as<Pressure>();
    if (!pressure || !pressure->gravity) continue;
    if (!(section.density > 0)) return i;
    pressure->value = section.mass() * *pressure->gravity;
  }
  return std::nullopt;
}

std::size_t shared_loads(const Problem& problem) {
  std::size_t own = 0;
  for (const auto& one : problem.load_cases) own += one.loads.size();
  return problem.loads.size() - own;
}

std::vector<std::size_t> loads_of(const Problem& problem, std::size_t which) {
  std::vector<std::size_t> result(shared_loads(problem));
  std::iota(result.begin(), result.end(), std::size_t(0));
  std::size_t first = result.size();
  for (std::size_t i = 0; i < which; ++i) first += problem.load_cases[i].loads.size();
  for (std::size_t i = 0; i < problem.load_cases[which].loads.size(); ++i) result.push_back(first + i);
  return result;
}

std::string key_of_load(const Problem& problem, std::size_t load) {
  const auto shared = shared_loads(problem);
  if (load < shared) return fmt::format("load[{}]", load);
  load -= shared;
  for (std::size_t i = 0; i < problem.load_cases.size(); ++i) {
    const auto own = problem.load_cases[i].loads.size();
    if (load < own) return fmt::format("case[{}].load[{}]", i, load);
    load -= own;
  }
  return "load";
}

std::vector<double> factors_of(const Combination& combination, const std::vector<LoadCase>& cases) {
  std::vector<double> result(cases.size(), 0);
  for (const auto& [name, factor] : combination.of) {
    const auto found = std::ranges::find(cases, name, &LoadCase::name);
    result[std::size_t(found - cases.begin())] += factor;
  }
  return result;
}

std::vector<Support> resolved_supports(const Problem& problem) {
  auto supports = problem.supports;
  if (problem.discretization.boundary == EdgeMethod::layer)
    for (auto& support : supports)
      if (support.holds_edges()) support.kind = in_layer(support.kind);
  return supports;
}

std::vector<geometry::CrackPath> crack_paths(const Problem& problem) {
  return geometry::crack_paths(problem.outline, problem.cracks, geometry::tolerance(problem.outline));
}

}  // namespace plate
