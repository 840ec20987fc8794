#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace plate {

/// Sums of several quantities over indices 0 ... size - 1, in parallel; the same bits for any number of threads,
/// because blocks of fixed size are added in a fixed order. term(i) -> std::array<double, N>.
template <std::size_t N, typename Term>
std::array<double, N> ordered_sum(std::size_t size, const Term& term) {
  constexpr std::size_t block = 4096;
  const std::size_t blocks = (size + block - 1) / block;
  std::vector<std::array<double, N>> partial(blocks);
#pragma omp parallel for schedule(static)
  for (std::size_t b = 0; b < blocks; ++b) {
    std::array<double, N> sum{};
    const std::size_t end = std::min(size, (b + 1) * block);
    for (std::size_t i = b * block; i < end; ++i) {
      const std::array<double, N> value = term(i);
      for (std::size_t n = 0; n < N; ++n) sum[n] += value[n];
    }
    partial[b] = sum;
  }
  std::array<double, N> total{};
  for (const auto& sum : partial)
    for (std::size_t n = 0; n < N; ++n) total[n] += sum[n];
  return total;
}

}  // namespace plate
