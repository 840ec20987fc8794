#pragma once
#include <stdexcept>

namespace plate {

/// The numbers failed: not finite, or an iteration that does not converge. The message says where and when.
class NumericalError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

}  // namespace plate
