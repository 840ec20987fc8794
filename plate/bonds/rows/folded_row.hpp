#pragma once
#include <utility>

#include "plate/bonds/rows/row_kernels.hpp"

namespace plate {

/// Largest i with i^2 + j^2 <= radius_squared.
constexpr int disc_width(int radius_squared, int j) {
  int i = 0;
  while ((i + 1) * (i + 1) + j * j <= radius_squared) ++i;
  return i;
}

/// A vector as wide as the columns beside a point on both sides, from several of the machine's where these are short.
template <typename Real>
using FoldLane = std::conditional_t<(Lane<Real>::size() >= 8), Lane<Real>, simd::fixed_size_simd<Real, 8>>;

/// A row whose points have all lattice bonds of a disc, with weights that are their own mirror image across the row and
/// along it. What lies i columns beside a point is summed over j once, for the two points that it lies beside, from
/// sums and differences of the rows j above and below, which serve all i: half of the arithmetic of pairs, and
/// a fraction of the loads. Sums stay in registers.
template <typename Real, int radius_squared>
class FoldedRow {
public:
  using Fold = typename RowPattern<Real>::Fold;
  static constexpr int reach = disc_width(radius_squared, 0);

  FoldedRow(const RowPattern<Real>& pattern, const Fields<Real>& in, std::ptrdiff_t first, std::ptrdiff_t length)
      : pattern_(pattern), fold_(*pattern.fold), in_(in), first_(first), length_(length) {}

  void dilatation(Real* q) {
    sweep<1>([&](std::ptrdiff_t c, std::ptrdiff_t at) { dilatation_columns(c, at); },
             [&](std::ptrdiff_t k, std::ptrdiff_t at, const auto& put) {
               put(pattern_.stiffness * gathered(at, 0), q + k);
             });
  }

  void force(const ForceFields<Real>& out) {
    const Vector reference = in_.w[first_];
    sweep<3>([&](std::ptrdiff_t c, std::ptrdiff_t at) { force_columns(c, at); },
             [&](std::ptrdiff_t k, std::ptrdiff_t at, const auto& put) {
               put(gathered(at, 0) - fold_.shear * (load(in_.w + k) - reference), out.force + k);
               put(gathered(at, 1) - pattern_.xx * load(in_.x + k), out.couple_x + k);
               put(gathered(at, 2) - pattern_.yy * load(in_.y + k), out.couple_y + k);
             });
  }

private:
  using Vector = FoldLane<Real>;
  using Part = Lane<Real>;  // for the columns, whose sums fill the machine's registers
  static constexpr auto size = std::ptrdiff_t(Vector::size());

  /// Contributions of the columns i beside a point: `even` is equal on both sides, `odd` has opposite signs.
  struct Sums {
    Part even = 0, odd = 0;
  };

  static constexpr std::ptrdiff_t block = 4, pitch = (block + 1) * size;  // vectors kept, numbers
  static_assert(2 * reach <= size);

  /// Calls columns(c, at) for every vector of columns, c counted from the first that a point of the row sees, and
  /// once all that a vector of points sees is there points(first point, at, put): `at` is its place in what is kept.
  template <int components, typename Columns, typename Points>
  void sweep(const Columns& columns, const Points& points) {
    const std::ptrdiff_t vectors = (length_ + 2 * reach + size - 1) / size, ends = (length_ + size - 1) / size;
    for (std::ptrdiff_t begin = 0; begin < vectors; begin += block) {
      const std::ptrdiff_t end = std::min(vectors, begin + block);
      for (std::ptrdiff_t c = 0; c < (end - begin) * size; c += std::ptrdiff_t(Part::size()))
        columns(begin * size + c, size + c);
      const std::ptrdiff_t last = end == vectors ? ends : end - 1;  // its neighbour to the right is not there yet
      for (std::ptrdiff_t v = std::max<std::ptrdiff_t>(begin - 1, 0); v < last; ++v)
        points(first_ + v * size, (v - begin + 1) * size, [&](const Vector& values, Real* to) {
          if ((v + 1) * size <= length_)
            values.copy_to(to, simd::element_aligned);
          else
            for (std::ptrdiff_t i = 0; i < length_ - v * size; ++i) to[i] = values[std::size_t(i)];
        });
      for (int i = -reach; i <= reach; ++i)
        for (int n = 0; n < components; ++n)
          load(kept(i, n) + (end - begin) * size).copy_to(kept(i, n), simd::element_aligned);
    }
  }

  /// Stored contributions of the current columns to the points i columns to their left (right: i < 0).
  Real* kept(int i, int component) { return kept_ + ((i + reach) * 3 + component) * pitch; }

  /// Sum of the contributions of the columns beside points of the row to these points.
  Vector gathered(std::ptrdiff_t at, int component) {
    Vector sum = load(kept(0, component) + at + reach);
    unrolled<reach>([&](auto i) __attribute__((always_inline)) {
      sum += load(kept(i + 1, component) + at + reach + i + 1);
      sum += load(kept(-i - 1, component) + at + reach - i - 1);
    });
    return sum;
  }

  void keep(int i, int component, std::ptrdiff_t at, const Sums& sums) {
    (sums.even + sums.odd).copy_to(kept(i, component) + at, simd::vector_aligned);
    if (i > 0) (sums.even - sums.odd).copy_to(kept(-i, component) + at, simd::vector_aligned);
  }

  template <typename Values = Vector>
  static Values load(const Real* from) {
    return Values(from, simd::element_aligned);
  }

  void dilatation_columns(std::ptrdiff_t c, std::ptrdiff_t at) {
    const std::ptrdiff_t k = first_ - reach + c;
    Sums sums[reach + 1];
    const typename RowPattern<Real>::Mirrored* bond = fold_.bonds.data();
    unrolled<reach + 1>([&](auto j) __attribute__((always_inline)) {
      const auto up = k + fold_.up[j], down = k + fold_.down[j];
      const Part y_up = load<Part>(in_.y + up);
      const Part y = j == 0 ? y_up : y_up + load<Part>(in_.y + down);
      const Part x = j == 0 ? Part(0) : load<Part>(in_.x + up) - load<Part>(in_.x + down);
      unrolled<disc_width(radius_squared, j) + 1>([&](auto i) __attribute__((always_inline)) {
        if constexpr (j > 0) sums[i].even += bond->Dx * x;
        if constexpr (i > 0) sums[i].odd += bond->Dy * y;
        ++bond;
      });
    });
    unrolled<reach + 1>([&](auto i) __attribute__((always_inline)) { keep(i, 0, at, sums[i]); });
  }

  void force_columns(std::ptrdiff_t c, std::ptrdiff_t at) {
    const std::ptrdiff_t k = first_ - reach + c;
    const Part reference = in_.w[first_];  // keeps rigid motions free of force
    Sums force[reach + 1], couple_x[reach + 1], couple_y[reach + 1];
    const typename RowPattern<Real>::Mirrored* bond = fold_.bonds.data();
    unrolled<reach + 1>([&](auto j) __attribute__((always_inline)) {
      const auto up = k + fold_.up[j], down = k + fold_.down[j];
      const auto below = [&](const Real* field) { return j == 0 ? Part(0) : load<Part>(field + down); };
      const Part w_up = load<Part>(in_.w + up) - reference, w_down = j == 0 ? Part(0) : below(in_.w) - reference;
      const Part x_up = load<Part>(in_.x + up), x_down = below(in_.x), y_up = load<Part>(in_.y + up),
                 y_down = below(in_.y);
      const Part q_up = load<Part>(in_.q + up), q_down = below(in_.q);
      const Part w = w_up + w_down, y = y_up + y_down, q = q_up + q_down, x = x_up + x_down;
      const Part dw = w_up - w_down, dx = x_up - x_down, dy = y_up - y_down, dq = q_up - q_down;
      unrolled<disc_width(radius_squared, j) + 1>([&](auto i) __attribute__((always_inline)) {
        force[i].even += bond->shear * w;
        if constexpr (j > 0) {
          force[i].even += bond->turn_x * dx;
          couple_x[i].even += bond->qx * dq;
          couple_x[i].even += bond->xx * x;
          couple_x[i].even += bond->wx * dw;
        }
        if constexpr (i > 0) {
          force[i].odd += bond->turn_y * y;
          couple_y[i].even += bond->yy * y;
          couple_y[i].odd += bond->qy * q;
          couple_y[i].odd += bond->wy * w;
        }
        if constexpr (i > 0 && j > 0) {
          couple_x[i].odd += bond->xy * dy;
          couple_y[i].odd += bond->xy * dx;
        }
        ++bond;
      });
    });
    unrolled<reach + 1>([&](auto i) __attribute__((always_inline)) {
      keep(i, 0, at, force[i]), keep(i, 1, at, couple_x[i]), keep(i, 2, at, couple_y[i]);
    });
  }

  const RowPattern<Real>& pattern_;
  const Fold& fold_;
  const Fields<Real>& in_;
  std::ptrdiff_t first_, length_;
  // one vector more: lanes beyond the end of a row, which nobody uses, are read with the others
  alignas(64) Real kept_[3 * (2 * reach + 1) * pitch + size];
};

/// Calls visit with the constant radius_squared for which the disc has the offsets of a fold: all horizons from 2 to 4
/// spacings.
template <typename Visit>
bool visit_disc(int radius_squared, const Visit& visit) {
  const auto one = [&]<int r>(std::integral_constant<int, r> constant) {
    if (r == radius_squared) visit(constant);
    return r == radius_squared;
  };
  return [&]<int... r>(std::integer_sequence<int, r...>) {
    return (one(std::integral_constant<int, r>{}) || ...);
  }
  (std::integer_sequence<int, 4, 5, 8, 9, 10, 13, 16>{});
}

}  // namespace plate
