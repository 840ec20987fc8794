#pragma once
#include <string>
#include <vector>

#include "plate/model/errors.hpp"
#include "plate/model/state.hpp"

namespace plate {

class Constraints;
class Formulation;
struct Analysis;
struct Problem;

/// Refusals that keep a plate from its analysis, and warnings about it.
struct Validation {
  std::vector<Refusal> refusals;
  std::vector<std::string> warnings;
};

/// Fewer modes than frequencies are asked for, pins within a spacing of one line, an equilibrium of a plate that is not
/// held, in whole or in a piece that cracks cut off, a preconditioner that cannot be made, large deflections that take
/// more memory than there is.
Validation validate(const Formulation& plate, const Analysis& analysis);

/// Refusals that can be found before there is a plate: a spacing with fewer than four cells across the plate, internal
/// forces in single precision in which so thin a plate would lose its shear strains.
std::vector<Refusal> errors_in_lengths(const Problem& problem, const Analysis& analysis);

/// Throws NumericalError of the first point with a displacement or rotation that is not finite.
void require_finite(const State& state, const std::string& when);
/// Throws it on every rank where one has such a point; collective.
void require_finite(const State& state, const std::string& when, const Constraints& constraints);

}  // namespace plate
