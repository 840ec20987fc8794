#pragma once
#include "plate/solve/motion/dynamics.hpp"

namespace plate {

class Formulation;
struct Analysis;

/// `rotary`: factor of the rotary inertia. Throws FormulaError where an expression has no value.
BeginOfMotion begin_of_motion(const Formulation& plate, double rotary);

/// The stable step of a plate with damping and contact, `free` being its own.
double stable_step(double free, const Formulation& plate, const Analysis& analysis, const BeginOfMotion& begin);

}  // namespace plate
