#include "plate/bonds/rows/tasks.hpp"

#include <algorithm>

namespace plate {

std::size_t Tasks::begin(int thread, int threads) const {
  if (until_.empty() || thread == threads) return until_.size();
  const double share = until_.back() * (double(thread) / threads);
  return std::size_t(std::lower_bound(until_.begin(), until_.end(), share) - until_.begin());
}

}  // namespace plate
