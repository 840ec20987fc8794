#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace plate {

class Exchange;

/// A point that a process has a copy of: where it is there, and whose it is.
struct Copy {
  std::uint32_t point;
  int owner;
  std::uint32_t of_owner;  // its number there
};

/// Rows of a symmetric matrix of 3 x 3 blocks that is positive but for rows of zeros, of the points of one process:
/// all points are numbered process by process.
struct SharedRows {
  std::vector<std::size_t> first{0};  // where the blocks of a row begin [own points + 1]
  std::vector<std::int64_t> column;   // numbers among all, ascending in every row
  std::vector<double> block;          // [9 x columns], row by row
  std::vector<double> position;       // of the points [2 x own points]: rigid motions are its softest vectors
};

/// An approximate inverse of such a matrix, symmetric; unknowns without stiffness stay zero.
class SharedInverse {
public:
  virtual ~SharedInverse() = default;
  /// Applies the inverse to the unknowns of the rank's own points [3 x points, point by point]. Collective: every rank
  /// must call it.
  virtual void apply(std::span<double> values) const = 0;
};

struct Traffic;
/// A symmetric matrix by its product with a vector: y = A x, of the unknowns of the process. All call it at once.
using SharedProduct = std::function<void(std::span<const double> x, std::span<double> y)>;

/// Which eigenpairs of such a matrix are wanted, and how they are found.
struct PairsWanted {
  std::size_t count = 1;    // of the largest eigenvalues
  std::size_t basis = 2;    // vectors kept at once, above `count`
  double tolerance = 1e-4;  // |A v - lambda v| <= tolerance lambda
  std::size_t most_restarts = 100;
};

/// Eigenvalues, largest first, and of every eigenvector, of length 1 over all processes, the unknowns of the process.
struct SharedPairs {
  std::vector<double> values;
  std::vector<std::vector<double>> vectors;
};

/// The processes that share a plate. What they do together all of them call, in the same order.
class Ranks {
public:
  virtual ~Ranks() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  virtual void sum(std::span<std::int64_t> values) const = 0;
  virtual void largest(std::span<double> values) const = 0;
  /// `texts`: one for every process; returns what every process has sent here.
  virtual std::vector<std::string> exchanged(std::vector<std::string> texts) const = 0;
  virtual std::unique_ptr<Exchange> exchange(std::size_t points, const std::vector<Copy>& copies) const = 0;
  virtual std::unique_ptr<SharedInverse> inverse(const SharedRows& rows) const = 0;
  /// Traffic that this rank has received so far; null where it is not counted.
  virtual const Traffic* traffic() const { return nullptr; }
  /// `start`: a vector to begin with. Fewer pairs than wanted where they are not found in so many restarts. What the
  /// product throws is thrown.
  virtual SharedPairs largest_pairs(const SharedProduct& product, std::span<const double> start,
                                    const PairsWanted& wanted) const = 0;
};

/// Communicator of the current thread; null where one process holds the whole plate.
const Ranks* ranks();

/// While it lives, the thread is one of these.
class AmongRanks {
public:
  explicit AmongRanks(const Ranks& ranks);
  ~AmongRanks();
  AmongRanks(const AmongRanks&) = delete;
  AmongRanks& operator=(const AmongRanks&) = delete;

private:
  const Ranks* before_;
};

/// Values of one kind as what processes send each other, and back.
template <typename T>
std::string text_of(const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::string text(values.size() * sizeof(T), '\0');
  if (!values.empty()) std::memcpy(text.data(), values.data(), text.size());
  return text;
}

template <typename T>
std::vector<T> values_of(const std::string& text) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<T> values(text.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), text.data(), text.size());
  return values;
}

/// Gathers the values of all ranks, one rank after the other.
template <typename T>
std::vector<T> gathered(const Ranks& all, const std::vector<T>& own) {
  std::vector<T> result;
  for (const auto& text : all.exchanged(std::vector<std::string>(std::size_t(all.size()), text_of(own)))) {
    const auto theirs = values_of<T>(text);
    result.insert(result.end(), theirs.begin(), theirs.end());
  }
  return result;
}

/// Sums of several quantities over all processes: the same bits however they are shared out, and with any number of
/// threads. Terms are rounded to multiples of 2^-60 of the largest, kept in two whole numbers, which add up exactly (n
/// terms err by n 2^-61 of the largest at most; n below 2^33). for_each(block, add) calls add(index of the sum, term)
/// for every term of a block, twice, from several threads. Not a number where a term is none, or infinite.
template <std::size_t N, typename ForEach>
std::array<double, N> exact_sum(const Ranks& ranks, std::size_t blocks, const ForEach& for_each) {
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
  ranks.largest(largest);
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
  ranks.sum(parts);
  std::array<double, N> result{};
  for (std::size_t n = 0; n < N; ++n) {
    if (largest[n] == infinity) result[n] = std::numeric_limits<double>::quiet_NaN();
    if (scale[n] > 0) result[n] = (double(parts[2 * n]) + double(parts[2 * n + 1]) / fine) / scale[n];
  }
  return result;
}

}  // namespace plate
