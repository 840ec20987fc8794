#pragma once
#include <optional>
#include <string>
#include <vector>

#include "post/factors/srif.hpp"

namespace post {

class Extremes;
class ReactionRows;
struct Summary;
struct Table;

/// Beyond this many thicknesses plates stretch: a clamped circular plate is 12 % stiffer there (Timoshenko: w + 0.488
/// w^3).
constexpr double small_deflection = 0.5;

/// What a run has found.
struct Found {
  const plate::Section& section;
  const std::optional<SrifOptions>& options;  // of the case
  bool si;                                    // numbers are in SI units
  const Table& history;
  const ReactionRows& reactions;
  std::vector<Srif> factors;  // at the end
};

/// Sets what summaries of all runs say alike: factors, at the faces too, reactions, the largest deflection, and warns
/// where a plate bends farther than small deflections reach: in SI units only, cases without units may be scaled.
void conclude(Summary& summary, Found found);

/// Where a run on one plate was largest, in motion with times. `rows` of factors at `times`.
void look_for_largest(Summary& summary, const plate::Section& section, const Extremes& extremes,
                      const std::vector<double>& times, const std::vector<std::vector<Srif>>& rows);

/// Where a crack would grow: tips that reach the toughness, at the end or, in motion, at any time.
std::vector<std::string> tips_that_grow(const Summary& summary);

}  // namespace post
