#pragma once
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>

namespace plate {

/// The numbers failed: not finite, or an iteration that does not converge. The message says where and when.
class NumericalError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
  NumericalError(const std::string& message, std::size_t at) : std::runtime_error(message), point(at) {}

  std::optional<std::size_t> point = {};  // where it is one
};

/// A stiffness that is not positive: something can move without resistance.
class NotPositive : public NumericalError {
public:
  using NumericalError::NumericalError;
};

}  // namespace plate
