#pragma once
#include "cases/case.hpp"
#include "plate/boundary.hpp"

namespace cases {

/// Adds warnings with the number that says why, where the model itself is not to be trusted: plates so thin that they
/// lock, families so coarse that the plate is not isotropic.
void warn_of_distrust(const Case& c, const plate::Boundary& boundary, std::vector<std::string>& warnings);

}  // namespace cases
