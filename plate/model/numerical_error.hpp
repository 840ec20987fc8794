#pragma once
#include <stdexcept>

namespace plate {

/// The numbers failed: not finite, or an iteration that does not converge. The message says where and when.
class NumericalError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// A stiffness that is not positive: something can move without resistance.
class NotPositive : public NumericalError {
public:
  using NumericalError::NumericalError;
};

}  // namespace plate
