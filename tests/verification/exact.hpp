#pragma once
#include "plate/model/section.hpp"

/// Closed-form solutions of the Mindlin plate, for tests and reports.
namespace plate::exact {

/// Deflection at (x, y) of a rectangle 0 <= x <= a, 0 <= y <= b, simply supported (hard) all round, under uniform
/// pressure: Navier's double series with the shear term, w_mn = p_mn / (D k^4) (1 + D k^2 / S), S = k_s G h
/// (Wang, Reddy & Lee 2000, chapter 6). `terms`: odd terms per direction.
double navier_deflection(const Section& section, double a, double b, double pressure, double x, double y,
                         int terms = 200);

/// Natural frequency [1/time] of mode (m, n) of that plate: the flexural root of the Mindlin frequency equation with
/// rotary inertia (Mindlin 1951; Liew et al. 1998).
double natural_frequency(const Section& section, double a, double b, int m, int n);

/// M_ss / M at the ends of the diameter across the bending, on a circular hole in an infinite plate under M_xx = M
/// (Reissner 1945): from (5 + 3 nu) / (3 + nu) in thin plates to 3 in thick ones.
double hole_moment_concentration(const Section& section, double radius);

}  // namespace plate::exact
