#pragma once
#include <optional>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"

namespace plate {

struct Problem;

/// Checks that a lattice of points (bonds over a horizon) can carry the problem. Throws Refused with all violations:
/// parts of the plate that have no points because they are no wider than a spacing, loaded edges without points, pins
/// and point forces that would move by more than a spacing, supports that act on less than one spacing. `cells`: the
/// outline in the cloud's units.
void check_lattice(const Problem& problem, const geometry::Cloud& cloud, const geometry::Outline& cells);

/// Distance of the pins that alone hold a plate from one common line: each acts up to 0.7 of a spacing beside its
/// place. Nothing where edges are held or there are fewer than three pins.
std::optional<double> width_of_pins(const Problem& problem, const geometry::LatticeUnits& units);

/// Distance from a place to the nearest point of the plate, at most twelve [spacings].
double distance_to_points(const geometry::Cloud& cloud, const geometry::Point& x);

/// Message for a place that is too far from the points. `away`, `most`: distance and its limit [spacings].
std::string too_far(const std::string& what, const geometry::Point& x, double away, double most);

/// Warnings for a plate of bonds over a horizon: thin plates, the layer beside free edges, lattices that are not
/// isotropic, oblique edges. `factors`: intensity factors are requested.
std::vector<std::string> warnings_about_bonds(const Formulation& plate, bool factors);

/// Warnings of warnings_about_bonds() that a comparison with the Galerkin plate replaces by numbers: shear locking of
/// thin plates, and stress at holes and clamped edges.
std::vector<std::string> estimated_errors(const Formulation& plate);

/// Share by which deflections usually are too large where edges are oblique to the lattice: stairs of the spacing.
double error_of_stairs(const Formulation& plate);

}  // namespace plate
