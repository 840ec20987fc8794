#pragma once
#include "plate/model/state.hpp"

namespace plate {

/// An approximate inverse of the stiffness on its free degrees of freedom, symmetric and positive.
class Preconditioner {
public:
  virtual ~Preconditioner() = default;

  /// result = M^-1 residual, zero at held degrees of freedom, as `residual` is [3 x points].
  virtual void apply(const Forces& residual, State& result) const = 0;

  virtual std::size_t bytes() const = 0;
};

}  // namespace plate
