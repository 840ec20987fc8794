#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plate/model/loads.hpp"

namespace plate {

struct Problem;

/// Loads that act together, beside those that all load cases share.
struct LoadCase {
  std::string name;
  std::vector<Load> loads;
};

/// A sum of load cases, each times its factor.
struct Combination {
  std::string name;
  std::vector<std::pair<std::string, double>> of;
};

/// A key of a case, such as "combination[0].of", and what is wrong with it.
struct KeyFault {
  std::string key, what;
};

/// Names that are given twice or unknown, load cases without loads, and combinations of nothing or of loads that all
/// load cases share, which would be counted as often as the factors say.
std::vector<KeyFault> faults_of_load_cases(const Problem& problem);

/// The problem with the loads of all its load cases behind those that they share.
void join_loads(Problem& problem);
/// Makes a load some times as large.
void scale(Load& load, double factor);
/// Gives loads by gravity their value, density thickness gravity [force/length^2]; the first of them where the section
/// has no density.
std::optional<std::size_t> settle_weights(Problem& problem);
/// How many loads all load cases share, after join_loads().
std::size_t shared_loads(const Problem& problem);
/// The loads of a problem, after join_loads(), that act in its load case `which`.
std::vector<std::size_t> loads_of(const Problem& problem, std::size_t which);
/// The key of a load of a problem, after join_loads(): "load[2]", "case[0].load[1]".
std::string key_of_load(const Problem& problem, std::size_t load);

/// What each load case counts for in a combination.
std::vector<double> factors_of(const Combination& combination, const std::vector<LoadCase>& cases);

}  // namespace plate
