#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace plate {

/// Numbers 0 ... size - 1 in sets that only grow together. The root of a set is its smallest number.
class DisjointSets {
public:
  explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t root(std::uint32_t k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[std::max(root(a), root(b))] = std::min(root(a), root(b)); }

private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace plate
