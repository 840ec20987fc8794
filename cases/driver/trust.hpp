#pragma once
#include "cases/input/case.hpp"
#include "plate/model/boundary.hpp"
#include "post/factors/srif.hpp"

namespace cases {

/// Adds warnings with the number that says why, where the model itself is not to be trusted: plates so thin that they
/// lock, families so coarse that the plate is not isotropic.
void warn_of_distrust(const Case& c, const plate::Boundary& boundary, std::vector<std::string>& warnings);

/// By which share deflections are usually off where bonds take straight edges oblique to the lattice for stairs; 0 in the
/// Galerkin plate.
double error_of_stairs(const Case& c, const plate::Boundary& boundary);

/// Adds warnings, with what to change, for the recommended factors of tips that are not resolved, or uncertain by more than
/// 3 % of the largest. `srifs`: the recommended of each tip first. `largest`: that every tip has had at other times, where there are.
void warn_of_factors(const Case& c, const std::vector<post::Srif>& srifs, const std::vector<double>& largest,
                     std::vector<std::string>& warnings);

}  // namespace cases
