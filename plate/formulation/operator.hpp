#pragma once
#include "plate/model/state.hpp"

namespace plate {

class PendingExchange;

/// Stiffness operator of a plate as the solvers use it: K = d2U/d(state)2 and its bounds.
class Operator {
public:
  virtual ~Operator() = default;

  virtual std::size_t points() const = 0;

  /// forces = -K state [3 x points].
  virtual void internal_force(const State& state, Forces& forces) const = 0;
  /// Computes the internal force of a state some of whose values are still in transit: points that need none of them go
  /// ahead. The exchange is complete afterwards.
  virtual void internal_force_overlapped(const State& state, PendingExchange& rest, Forces& forces) const;

  /// An upper bound of |K| state for a state without negative entries [3 x points].
  virtual void absolute_product(const State& state, Forces& forces) const = 0;

  /// The diagonal of K [3 x points].
  virtual Forces diagonal() const = 0;
};

/// Strain energy of a state by the work of its forces, of one process.
double half_work(const Operator& plate, const State& state);

/// An approximate inverse of the stiffness on its free degrees of freedom, symmetric and positive.
class Preconditioner {
public:
  virtual ~Preconditioner() = default;

  /// result = M^-1 residual, zero at held degrees of freedom, as `residual` is [3 x points].
  virtual void apply(const Forces& residual, State& result) const = 0;

  virtual std::size_t bytes() const = 0;
};

}  // namespace plate
