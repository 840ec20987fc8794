#pragma once
#include <stdexcept>
#include <string>

#include "plate/solve/motion/dynamics.hpp"

namespace plate {

class Formulation;
struct Analysis;
struct DampedStep;

/// A deflection with which no plate begins: it jumps, or is not zero where a support holds it.
class Jumps : public std::domain_error {
public:
  Jumps(std::string formula, const std::string& what) : std::domain_error(what), formula_(std::move(formula)) {}
  const std::string& formula() const { return formula_; }

private:
  std::string formula_;
};

/// `rotary`: factor of the rotary inertia. Throws FormulaError where an expression has no value, Jumps.
BeginOfMotion begin_of_motion(const Formulation& plate, double rotary);

/// The stable step of a plate with damping and contact, `free` being its own.
double stable_step(double free, const Formulation& plate, const Analysis& analysis, const BeginOfMotion& begin);
/// Stable step with damping that may relax: not where supports move, nor where the given time step needs none of it.
DampedStep damped_step(double free, const Formulation& plate, const Analysis& analysis, const BeginOfMotion& begin);

}  // namespace plate
