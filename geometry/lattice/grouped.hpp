#pragma once
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace geometry {

/// Values in numbered groups, all in one array.
template <typename Value>
class Grouped {
public:
  Grouped() = default;
  /// `for_each(visit)` calls visit(group, value) for all values. It is called twice; a group has its values in the
  /// order of these calls.
  template <typename ForEach>
  Grouped(std::size_t groups, const ForEach& for_each) : end_(groups + 2, 0) {
    for_each([&](std::size_t group, const Value&) { ++end_[group + 2]; });
    std::partial_sum(end_.begin(), end_.end(), end_.begin());
    values_.resize(end_.back());
    for_each([&](std::size_t group, const Value& value) { values_[end_[group + 1]++] = value; });
  }

  std::span<const Value> operator[](std::size_t group) const {
    return {values_.data() + end_[group], end_[group + 1] - end_[group]};
  }

private:
  std::vector<std::size_t> end_;  // of the group before each: 0, then behind the first, ...
  std::vector<Value> values_;
};

}  // namespace geometry
