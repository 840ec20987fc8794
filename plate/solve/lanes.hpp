#pragma once
#include <algorithm>
#include <cstdint>
#include <experimental/simd>
#include <utility>

/// Values of several points at once, for the kernels of LatticeRows.
namespace plate {

namespace simd = std::experimental;
template <typename Real>
using Lane = simd::native_simd<Real>;

/// Lanes of several machine vectors of neighbouring points, so that what a bond broadcasts serves all of them.
template <typename Real, std::size_t N>
struct Lanes {
  static constexpr std::size_t size = N * Lane<Real>::size();
  Lane<Real> part[N];

  static Lanes load(const Real* from) {
    Lanes result;
    for (std::size_t i = 0; i < N; ++i) result.part[i].copy_from(from + i * Lane<Real>::size(), simd::element_aligned);
    return result;
  }
  static Lanes constant(Real value) {
    Lanes result;
    for (auto& part : result.part) part = value;
    return result;
  }
  void store(Real* to) const {
    for (std::size_t i = 0; i < N; ++i) part[i].copy_to(to + i * Lane<Real>::size(), simd::element_aligned);
  }
};

template <typename Real, std::size_t N, typename Op>
Lanes<Real, N> each(const Lanes<Real, N>& a, const Lanes<Real, N>& b, const Op& op) {
  Lanes<Real, N> result;
  for (std::size_t i = 0; i < N; ++i) result.part[i] = op(a.part[i], b.part[i]);
  return result;
}
template <typename Real, std::size_t N>
Lanes<Real, N> operator+(const Lanes<Real, N>& a, const Lanes<Real, N>& b) {
  return each(a, b, [](const auto& x, const auto& y) { return x + y; });
}
template <typename Real, std::size_t N>
Lanes<Real, N> operator-(const Lanes<Real, N>& a, const Lanes<Real, N>& b) {
  return each(a, b, [](const auto& x, const auto& y) { return x - y; });
}
template <typename Real, std::size_t N>
Lanes<Real, N> operator*(const Lanes<Real, N>& a, const Lanes<Real, N>& b) {
  return each(a, b, [](const auto& x, const auto& y) { return x * y; });
}
template <typename Real, std::size_t N>
Lanes<Real, N> operator*(Real factor, const Lanes<Real, N>& a) {
  Lanes<Real, N> result;
  for (std::size_t i = 0; i < N; ++i) result.part[i] = factor * a.part[i];
  return result;
}
template <typename Real, std::size_t N>
Lanes<Real, N>& operator+=(Lanes<Real, N>& a, const Lanes<Real, N>& b) {
  for (std::size_t i = 0; i < N; ++i) a.part[i] += b.part[i];
  return a;
}

/// Points that follow each other from k on.
template <typename Real, std::size_t N>
struct Following {
  using Vector = Lanes<Real, N>;
  std::ptrdiff_t k;

  Vector load(const Real* values, std::ptrdiff_t step = 0) const { return Vector::load(values + k + step); }
  void store(const Vector& value, Real* values) const { value.store(values + k); }
};

/// Calls visit with the constants 0 ... count - 1.
template <int count, typename Visit>
[[gnu::always_inline]] inline void unrolled(const Visit& visit) {
  [&]<int... i>(std::integer_sequence<int, i...>) __attribute__((always_inline)) {
    (visit(std::integral_constant<int, i>{}), ...);
  }
  (std::make_integer_sequence<int, count>{});
}

/// Element by element: the gather instruction is slow where the processor guards against leaks through it.
template <typename Real>
Lane<Real> gather(const Real* values, const std::uint32_t* points) {
  return Lane<Real>([&](auto i) { return values[points[i]]; });
}

/// Calls visit for pieces of a row, wide ones where it is long enough. The last piece may overlap those before it: the
/// same values are computed twice. Rows must be as long as a vector.
template <typename Real, typename Visit>
void along(std::ptrdiff_t first, std::ptrdiff_t length, const Visit& visit) {
  const auto cut = [&]<std::size_t N>(std::integral_constant<std::size_t, N>) {
    constexpr auto size = std::ptrdiff_t(Lanes<Real, N>::size);
    for (std::ptrdiff_t k = first; k < first + length; k += size)
      visit(Following<Real, N>{std::min(k, first + length - size)});
  };
  if (length >= std::ptrdiff_t(Lanes<Real, 2>::size))
    cut(std::integral_constant<std::size_t, 2>{});
  else
    cut(std::integral_constant<std::size_t, 1>{});
}

}  // namespace plate
