#pragma once
#include <functional>

/// The surface effect of a bar without corrections (Sca21 2.2, appendix B). Lengths are over the horizon, x is measured
/// from the end of the bar.
namespace boundary_bodies {

/// Weighted volume over that of an infinite bar (Sca21, table 1).
double weighted_volume_near_end(double x);

/// Force flux over E strain (Sca21, table 2).
double flux_near_end(double x);

/// Load that holds a uniform strain, over E strain / horizon: minus the slope of the flux (Sca21, table B1).
double load_near_end(double x);

/// The three by quadrature of the integrals that they stand for (Sca21 25, 24, B1).
double integrated_weighted_volume(double x);
double integrated_flux(double x);
double integrated_load(double x);

/// Integral by Gauss' rule in parts that end at 1, where the weighted volume has its kink.
double integral_in_parts(const std::function<double(double)>& f, double from, double to);

/// The place where f(x) passes `level` between `low` and `high`, by bisection to 1e-12; f(low) < level there.
double place_of(const std::function<double(double)>& f, double level, double low, double high);

}  // namespace boundary_bodies
