#pragma once
#include <string>
#include <vector>

#include "plate/model/errors.hpp"

namespace plate {

struct Problem;

/// Springs that are nowhere or at several places at once, that resist nothing, that resist what their place does not
/// have or what a support of the same edge holds; foundations and springs beside edges that no images stand for.
std::vector<Refusal> errors_in_springs(const Problem& problem);

/// Warns of round holes simply supported all round, which all but clamps them, and of pins on rims, which are soft.
std::vector<std::string> warnings_about_held_holes(const Problem& problem);

/// Warns of hubs on the plate whose rims are closer than a spacing to an edge, a crack or another of them.
std::vector<std::string> warnings_about_hubs(const Problem& problem);

/// Settlements of supports that there are not, that hold nothing of what is moved, or that meet others which hold the
/// same place elsewhere; settlements beside nodes at edges.
std::vector<Refusal> errors_in_settlements(const Problem& problem);

}  // namespace plate
