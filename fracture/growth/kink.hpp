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

}  // namespace fracture
