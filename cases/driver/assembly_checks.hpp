#pragma once
#include "cases/input/case_file.hpp"
#include "plate/bonds/law.hpp"
#include "plate/solve/mechanisms.hpp"

/// What may be wrong with a case once it is turned into points and bonds. Each throws CaseError, or adds a warning
/// where a run still makes sense.
namespace cases {

/// Statics: nothing may move freely. Otherwise a loose piece is allowed, and said.
void check_held(const CaseFile& file, const std::vector<plate::Piece>& pieces, std::vector<std::string>& warnings);

/// A ligament one row of points wide is a hinge. Statics: no load may turn it; else it is said.
void check_mechanisms(const CaseFile& file, const plate::Mechanisms& found, std::vector<std::string>& warnings);

/// An edge along the lattice that is held lies on a boundary between cells.
void check_edges_fit(const plate::Boundary& boundary, double spacing, std::vector<std::string>& warnings);

/// A plate of n degrees of freedom has n modes; a quarter of them is more than anyone can mean.
void check_modes(const CaseFile& file, const plate::Boundary& boundary);

/// A lattice that is far from isotropic at its rim cannot be fitted with a weight that is not negative.
void check_weights(const CaseFile& file, const std::vector<plate::BondShape>& shapes);

}  // namespace cases
