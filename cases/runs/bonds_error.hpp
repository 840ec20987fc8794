#pragma once
#include <string>
#include <vector>

#include "plate/model/state.hpp"

namespace plate {
class Formulation;
struct FrequencyOptions;
struct Problem;
}  // namespace plate

namespace cases {

/// Replaces the estimated errors of deflections and stresses of bonds (plate::estimated_errors) by how far they are
/// from those of the Galerkin plate with the same spacing. Nothing happens to plates that are not compared: those of
/// more than 40,000 points that are thick, and those that processes share. `problem`: as the case has it.
void compare_with_galerkin(const plate::Formulation& bonds, const plate::State& state, const plate::Problem& problem,
                           std::vector<std::string>& warnings);

/// Compares deflections under a uniform pressure in the same way, for plates that are thin, held and not solved at
/// rest. `remedy`: what to set.
void compare_under_pressure(const plate::Formulation& bonds, const plate::Problem& problem,
                            std::vector<std::string>& warnings, const std::string& remedy);

/// Compares the first frequency of bonds that are held [1/time] with that of the Galerkin plate with the same spacing.
/// Nothing happens to plates that are not compared: those of more than 40,000 points, and those that processes share.
/// `options`: those of the bonds.
void compare_first_frequency(const plate::Formulation& bonds, double frequency, const plate::Problem& problem,
                             const plate::FrequencyOptions& options, double rotary_inertia,
                             std::vector<std::string>& warnings);

}  // namespace cases
