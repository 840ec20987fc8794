#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <vector>
#include "plate/model/communicator.hpp"

namespace plate {

/// Sums of several quantities over indices 0 ... size - 1, in parallel; the same bits for any number of threads,
/// because blocks of fixed size are added in a fixed order, eight sums side by side. Terms must not depend on each
/// other. term(i) -> std::array<double, N>. Where processes share the plate, over all of theirs, and exact.
template <std::size_t N, typename Term>
std::array<double, N> ordered_sum(std::size_t size, const Term& term) {
  constexpr std::size_t block = 4096, lanes = 8;
  const std::size_t blocks = (size + block - 1) / block;
  if (const Ranks* all = ranks())
    return exact_sum<N>(*all, blocks, [&](std::size_t b, const auto& add) {
      for (std::size_t i = b * block; i < std::min(size, (b + 1) * block); ++i) {
        const std::array<double, N> value = term(i);
        for (std::size_t n = 0; n < N; ++n) add(n, value[n]);
      }
    });
  std::vector<std::array<double, N>> partial(blocks);
#pragma omp parallel for schedule(static)
  for (std::size_t b = 0; b < blocks; ++b) {
    std::array<std::array<double, lanes>, N> sums{};
    const std::size_t end = std::min(size, (b + 1) * block);
    std::size_t i = b * block;
    for (; i + lanes <= end; i += lanes) {
#pragma omp simd
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const std::array<double, N> value = term(i + lane);
        for (std::size_t n = 0; n < N; ++n) sums[n][lane] += value[n];
      }
    }
    for (; i < end; ++i) {
      const std::array<double, N> value = term(i);
      for (std::size_t n = 0; n < N; ++n) sums[n][0] += value[n];
    }
    for (std::size_t n = 0; n < N; ++n) partial[b][n] = std::accumulate(sums[n].begin(), sums[n].end(), 0.0);
  }
  std::array<double, N> total{};
  for (const auto& sum : partial)
    for (std::size_t n = 0; n < N; ++n) total[n] += sum[n];
  return total;
}

/// The largest of one number of every process that shares the plate.
inline double largest_of_all(double value) {
  if (const Ranks* all = ranks()) all->largest({&value, 1});
  return value;
}

/// The sum of one number of every process that shares the plate.
inline double sum_of_all(double value) {
  return ranks() ? ordered_sum<1>(1, [&](std::size_t) { return std::array<double, 1>{value}; })[0] : value;
}

}  // namespace plate
