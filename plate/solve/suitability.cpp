#include "plate/solve/suitability.hpp"

#include <fmt/format.h>

#include "plate/formulation/formulation.hpp"
#include "plate/formulation/parts/held.hpp"
#include "plate/formulation/parts/pieces.hpp"
#include "plate/solve/analysis.hpp"

namespace plate {
namespace {

void check_modes(const Formulation& plate, const Analysis& analysis, Suitability& result) {
  if (analysis.kind != Analysis::Kind::frequencies) return;
  const auto most = std::size_t((plate.mass().array() > 0).count()) / 4;
  if (analysis.modes > most)
    result.refusals.push_back({Subject::modes, 0,
                               fmt::format("{} given, must be at most {}, a quarter of the plate's degrees of freedom",
                                           analysis.modes, most)});
}

/// Pins alone hold a plate by their triangle; each acts up to 0.7 of a spacing beside its place.
void check_pins(const Formulation& plate, const Analysis& analysis, Suitability& result) {
  constexpr double least = 1, few = 5;  // spacings
  const auto wide = plate.width_of_pins();
  if (!wide || analysis.kind != Analysis::Kind::static_) return;
  const auto said = fmt::format(
      "the pins are within {:.2g} spacings of one line, and each acts at the nearest point of the lattice, up "
      "to 0.7 spacings from its place",
      *wide);
  if (*wide < least)
    result.refusals.push_back({Subject::support, 0, said + ": refine, or choose formulation = \"galerkin\""});
  else if (*wide < few)
    result.warnings.push_back(said + ": deflections may be far off");
}

/// In motion a plate may move as it is; that pieces do is worth a word.
void check_held(const Formulation& plate, const Analysis& analysis, Suitability& result) {
  const auto found = loose(plate);
  if (analysis.finds_equilibrium())
    result.refusals.insert(result.refusals.end(), found.begin(), found.end());
  else if (!found.empty() && plate.pieces().size() > 1 && !plate.held())
    for (const auto& one : found) result.warnings.push_back(one.what);
}

void check_two_level(const Formulation& plate, const Analysis& analysis, Suitability& result) {
  if (plate.may_move() && analysis.preconditioner == Preconditioning::two_level)
    result.refusals.push_back(
        {Subject::preconditioner, 0,
         "\"two_level\" needs a plate without motions that nothing resists, and parts of this one hang by bonds along "
         "one line; choose \"diagonal\""});
}

}  // namespace

Suitability suitability(const Formulation& plate, const Analysis& analysis) {
  Suitability result;
  check_modes(plate, analysis, result);
  check_pins(plate, analysis, result);
  check_held(plate, analysis, result);
  check_two_level(plate, analysis, result);
  return result;
}

}  // namespace plate
