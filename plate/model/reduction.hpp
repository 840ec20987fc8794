#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <vector>
#include "plate/model/communicator.hpp"
#include "plate/model/point_map.hpp"

namespace plate {

/// The communicator of what ranks share: a map of points, constraints, a plate. Reductions take any of
/// them.
inline const Communicator& communicator_of(const Communicator& all) {
  return all;
}
template <typename Shared>
requires requires(const Shared& shared) {
  { *shared.communicator } -> std::same_as<const Communicator&>;
}
const Communicator& communicator_of(const Shared& shared) {
  return *shared.communicator;
}
template <typename Shared>
requires requires(const Shared& shared) {
  { shared.communicator() } -> std::same_as<const Communicator&>;
}
const Communicator& communicator_of(const Shared& shared) {
  return shared.communicator();
}

/// Returns the largest value of all ranks that share a plate, its constraints or a map of its points; collective, as
/// all reductions here.
template <typename Shared>
double largest_of(const Shared& shared, double value) {
  communicator_of(shared).largest({&value, 1});
  return value;
}

/// Returns the sums of whole numbers of every rank.
template <typename Shared, std::size_t N>
std::array<std::int64_t, N> counts_of_all(const Shared& shared, std::array<std::int64_t, N> own) {
  communicator_of(shared).sum(own);
  return own;
}
template <typename Shared>
std::int64_t count_of_all(const Shared& shared, std::int64_t own) {
  return counts_of_all(shared, std::array{own})[0];
}

/// Waits until all ranks are here.
template <typename Shared>
void wait_for_all(const Shared& shared) {
  count_of_all(shared, 1);
}

/// Returns the text of every rank.
template <typename Shared>
std::vector<std::string> texts_of_all(const Shared& shared, const std::string& own) {
  return communicator_of(shared).text_of_each(own);
}

/// Gathers the values of all ranks, one rank after the other.
template <typename Shared, typename T>
std::vector<T> gathered(const Shared& shared, const std::vector<T>& own) {
  std::vector<T> result;
  for (const auto& text : texts_of_all(shared, text_of(own))) {
    const auto theirs = values_of<T>(text);
    result.insert(result.end(), theirs.begin(), theirs.end());
  }
  return result;
}

/// Sums of several quantities over all processes: the same bits however they are shared out, and with any number of
/// threads. Terms are rounded to multiples of 2^-60 of the largest, kept in two whole numbers, which add up exactly (n
/// terms err by n 2^-61 of the largest at most; n below 2^33). for_each(block, add) calls add(index of the sum, term)
/// for every term of a block, twice, from several threads. Not a number where a term is none, or infinite.
template <std::size_t N, typename Shared, typename ForEach>
std::array<double, N> exact_sum(const Shared& shared, std::size_t blocks, const ForEach& for_each) {
  const Communicator& all = communicator_of(shared);
  constexpr double infinity = std::numeric_limits<double>::infinity(), fine = 1 << 30;
  std::array<double, N> largest{};
#pragma omp parallel
  {
    std::array<double, N> own{};
    const auto add = [&own](std::size_t n, double term) {
      own[n] = std::isfinite(term) ? std::max(own[n], std::abs(term)) : infinity;
    };
#pragma omp for schedule(static)
    for (std::size_t b = 0; b < blocks; ++b) for_each(b, add);
#pragma omp critical
    for (std::size_t n = 0; n < N; ++n) largest[n] = std::max(largest[n], own[n]);
  }
  all.largest(largest);
  std::array<double, N> scale{};  // 2^30 over a power of two above the largest; 0: nothing to add
  for (std::size_t n = 0; n < N; ++n) {
    int exponent = 0;
    std::frexp(largest[n], &exponent);
    if (largest[n] > 0 && largest[n] < infinity) scale[n] = std::ldexp(1.0, std::min(30 - exponent, 1000));
  }
  std::array<std::int64_t, 2 * N> parts{};
#pragma omp parallel
  {
    std::array<std::int64_t, 2 * N> own{};
    const auto add = [&own, &scale](std::size_t n, double term) {
      if (scale[n] == 0) return;
      const double scaled = term * scale[n], high = std::nearbyint(scaled);
      own[2 * n] += std::int64_t(high);
      own[2 * n + 1] += std::int64_t(std::nearbyint((scaled - high) * fine));
    };
#pragma omp for schedule(static)
    for (std::size_t b = 0; b < blocks; ++b) for_each(b, add);
#pragma omp critical
    for (std::size_t i = 0; i < parts.size(); ++i) parts[i] += own[i];
  }
  all.sum(parts);
  std::array<double, N> result{};
  for (std::size_t n = 0; n < N; ++n) {
    if (largest[n] == infinity) result[n] = std::numeric_limits<double>::quiet_NaN();
    if (scale[n] > 0) result[n] = (double(parts[2 * n]) + double(parts[2 * n + 1]) / fine) / scale[n];
  }
  return result;
}

/// Sums of several quantities over indices 0 ... size - 1, in parallel; the same bits for any number of threads,
/// because blocks of fixed size are added in a fixed order, eight sums side by side. Terms must not depend on each
/// other. term(i) -> std::array<double, N>. Where the plate is distributed, over all of theirs, and exact.
template <std::size_t N, typename Shared, typename Term>
std::array<double, N> ordered_sum(const Shared& shared, std::size_t size, const Term& term) {
  const Communicator& all = communicator_of(shared);
  constexpr std::size_t block = 4096, lanes = 8;
  const std::size_t blocks = (size + block - 1) / block;
  if (all.distributed())
    return exact_sum<N>(all, blocks, [&](std::size_t b, const auto& add) {
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

/// Sums of several quantities over a few items, added one after the other: for_each(item, add) calls add(index of the
/// sum, term). Where the plate is distributed, over those of all ranks, and exact.
template <std::size_t N, typename Shared, typename ForEach>
std::array<double, N> sum_of_items(const Shared& shared, std::size_t items, const ForEach& for_each) {
  if (communicator_of(shared).distributed()) return exact_sum<N>(shared, items, for_each);
  std::array<double, N> result{};
  for (std::size_t i = 0; i < items; ++i) for_each(i, [&](std::size_t n, double term) { result[n] += term; });
  return result;
}

/// The sum of one number of every rank that shares the plate.
template <typename Shared>
double sum_of_all(const Shared& shared, double value) {
  if (!communicator_of(shared).distributed()) return value;
  return exact_sum<1>(shared, 1, [&](std::size_t, const auto& add) { add(0, value); })[0];
}

}  // namespace plate
