#pragma once
#include "fracture/growth/criteria.hpp"
#include "plate/model/section.hpp"

namespace fracture {

/// Moment and shear intensity factors of a tip.
struct Factors {
  double K1, K2, K3;
};

/// Factors at the tip of a short piece that leaves a tip at `angle` (counter-clockwise), to the first order of its
/// length: those of the moment M_tt and M_tr and of the shear force Q_t on the line ahead under that angle (theory.md,
/// "Growth").
Factors kinked(const Factors& factors, double angle);

/// The angle in which a tip goes on [rad, counter-clockwise], in [-pi/2, pi/2].
double kink_angle(const Factors& factors, Growth::Direction direction, const plate::Section& section);

/// The most by which kink_angle() changes where each factor is off by its error [rad]; pi where an error is not known
/// (infinite). Errors of the factors are estimates.
double kink_error(const Factors& factors, const Factors& errors, Growth::Direction direction,
                  const plate::Section& section);

/// The error of the square root of the energy release rate, relative to it: load factors have the same. Infinite where
/// an error is not known.
double release_error(const Factors& factors, const Factors& errors, const plate::Section& section);

/// The turn that a tip makes, and whether the errors of its factors leave it a direction.
struct Turn {
  double angle = 0;  // [rad]; 0 where it is no larger than its error
  double error = 0;  // kink_error()
  double asked = 0;  // kink_angle()
  /// Is the direction known within half of what a kink may be?
  bool known() const;
  /// False: the tip would turn by more than it may be left straight, and its direction is not known.
  bool resolved() const;
};

/// `share`: of its error that a turn must exceed to be made.
Turn turn_of(const Factors& factors, const Factors& errors, Growth::Direction direction, const plate::Section& section,
             double share = 1);

/// Does the angle count as a turn? From one degree on [rad].
bool turns(double angle);

}  // namespace fracture
