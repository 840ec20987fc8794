#pragma once
#include <algorithm>
#include <cstdint>
#include <experimental/simd>

/// Values of several points at once, for the kernels of LatticeOperator.
namespace plate {

namespace simd = std::experimental;
using Lane = simd::native_simd<double>;

/// Several machine vectors of neighbouring points, so that what a bond broadcasts serves all of them.
template <std::size_t N>
struct Lanes {
  static constexpr std::size_t size = N * Lane::size();
  Lane part[N];

  static Lanes load(const double* from) {
    Lanes result;
    for (std::size_t i = 0; i < N; ++i) result.part[i].copy_from(from + i * Lane::size(), simd::element_aligned);
    return result;
  }
  static Lanes constant(double value) {
    Lanes result;
    for (auto& part : result.part) part = value;
    return result;
  }
  void store(double* to) const {
    for (std::size_t i = 0; i < N; ++i) part[i].copy_to(to + i * Lane::size(), simd::element_aligned);
  }
};

template <std::size_t N, typename Op>
Lanes<N> each(const Lanes<N>& a, const Lanes<N>& b, const Op& op) {
  Lanes<N> result;
  for (std::size_t i = 0; i < N; ++i) result.part[i] = op(a.part[i], b.part[i]);
  return result;
}
template <std::size_t N>
Lanes<N> operator+(const Lanes<N>& a, const Lanes<N>& b) {
  return each(a, b, [](const Lane& x, const Lane& y) { return x + y; });
}
template <std::size_t N>
Lanes<N> operator-(const Lanes<N>& a, const Lanes<N>& b) {
  return each(a, b, [](const Lane& x, const Lane& y) { return x - y; });
}
template <std::size_t N>
Lanes<N> operator*(const Lanes<N>& a, const Lanes<N>& b) {
  return each(a, b, [](const Lane& x, const Lane& y) { return x * y; });
}
template <std::size_t N>
Lanes<N> operator*(double factor, const Lanes<N>& a) {
  Lanes<N> result;
  for (std::size_t i = 0; i < N; ++i) result.part[i] = factor * a.part[i];
  return result;
}
template <std::size_t N>
Lanes<N>& operator+=(Lanes<N>& a, const Lanes<N>& b) {
  for (std::size_t i = 0; i < N; ++i) a.part[i] += b.part[i];
  return a;
}

/// Points that follow each other from k on.
template <std::size_t N>
struct Following {
  using Vector = Lanes<N>;
  std::size_t k;

  Vector load(const double* values, std::int32_t step = 0) const { return Vector::load(values + k + step); }
  void store(const Vector& value, double* values) const { value.store(values + k); }
};

inline Lane gather(const double* values, const std::uint32_t* points, std::int32_t step) {
  // element by element: the gather instruction is slow where the processor guards against leaks through it
  return Lane([&](auto i) { return values[static_cast<std::ptrdiff_t>(points[i]) + step]; });
}

/// The points of a packet, of which the last ones may repeat.
struct Scattered {
  using Vector = Lanes<1>;
  const std::uint32_t* points;
  std::size_t used;

  Vector load(const double* values, std::int32_t step = 0) const { return {{gather(values, points, step)}}; }
  void store(const Vector& value, double* values) const {
    for (std::size_t i = 0; i < used; ++i) values[points[i]] = value.part[0][i];
  }
};

/// Calls visit for pieces of a row, wide ones where it is long enough. The last piece may overlap those before it: the
/// same values are computed twice.
template <typename Visit>
void along(std::size_t first, std::size_t length, const Visit& visit) {
  const auto cut = [&]<std::size_t N>(std::integral_constant<std::size_t, N>) {
    constexpr std::size_t size = N * Lane::size();
    for (std::size_t k = first; k < first + length; k += size) visit(Following<N>{std::min(k, first + length - size)});
  };
  if (length >= 2 * Lane::size())
    cut(std::integral_constant<std::size_t, 2>{});
  else
    cut(std::integral_constant<std::size_t, 1>{});
}

}  // namespace plate
