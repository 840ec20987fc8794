#pragma once
#include "plate/model/state.hpp"

namespace plate {

/// What the solvers ask of a plate: K = d2U/d(state)2 and what bounds it.
class Operator {
public:
  virtual ~Operator() = default;

  virtual std::size_t points() const = 0;

  /// forces = -K state [3 x points].
  virtual void internal_force(const State& state, Forces& forces) const = 0;

  /// An upper bound of |K| state for a state without negative entries [3 x points].
  virtual void absolute_product(const State& state, Forces& forces) const = 0;

  /// The diagonal of K [3 x points].
  virtual Forces diagonal() const = 0;
};

}  // namespace plate
