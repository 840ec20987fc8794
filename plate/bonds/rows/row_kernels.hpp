#pragma once
#include <optional>
#include <span>

#include "plate/bonds/family_operator.hpp"
#include "plate/solve/lanes.hpp"

namespace plate {

/// The bonds of a point of a row, in the forms of the row kernels: what does not depend on the states is multiplied
/// out. m, D, curvature and shear as in PatternBond; `Real` is the number of the kernel.
template <typename Real>
struct RowPattern {
  /// Two opposite bonds with equal weights.
  struct Pair {
    Real mx, my, half_length;
    Real Dx, Dy;  // D_kj m
    Real D_jk, shear;
    Real bend, g;  // of the curvature and shear differences in the couple
    std::int32_t plus, minus;
  };
  struct Single {
    Real mx, my, half_length;
    Real Dx, Dy;
    Real D_jk, shear, bend, g;
    std::int32_t step;
  };
  /// Bonds to (+-i, +-j) with equal weights; of the one to (i, j):
  struct Mirrored {
    Real Dx, Dy;                 // D_kj m
    Real shear, turn_x, turn_y;  // force per w and rotation
    Real qx, qy;                 // couple per q
    Real xx, xy, yy;             // couple per rotation
    Real wx, wy;                 // couple per w
  };
  /// Bonds of a disc, each with the weights of its mirror images.
  struct Fold {
    int radius_squared;                    // [spacing^2]
    std::vector<std::ptrdiff_t> up, down;  // by j: steps to (0, j) and (0, -j)
    std::vector<Mirrored> bonds;           // of every j those of i = 0 on; the first one is none
    Real shear;                            // sum over all bonds
  };

  std::vector<Pair> pairs;
  std::vector<Single> singles;
  std::optional<Fold> fold;              // then neither pairs nor singles
  Real stiffness = 0;                    // 2 A a
  Real Dx = 0, Dy = 0;                   // couple, per q
  Real xx = 0, xy = 0, yy = 0;           // couple, per rotation
  Real force_x = 0, force_y = 0;         // force, per rotation
  std::int64_t lowest = 0, highest = 0;  // steps that the kernel reads about a point
};

/// Bond vectors of a pattern in spacings, where all of them are whole numbers.
struct LatticeOffset {
  std::int32_t i, j;
  auto operator<=>(const LatticeOffset&) const = default;
};
std::optional<LatticeOffset> lattice_offset(const PatternBond& bond, double spacing);

/// Folded where the bonds allow it and `spacing`, the shortest bond of the plate, is given.
template <typename Real>
RowPattern<Real> row_pattern(std::span<const PatternBond> bonds, double stiffness, std::optional<double> spacing);

extern template RowPattern<double> row_pattern<double>(std::span<const PatternBond>, double, std::optional<double>);
extern template RowPattern<float> row_pattern<float>(std::span<const PatternBond>, double, std::optional<double>);

// Kernels for a row of points with one pattern of bonds: Dai 11-13 for a vector of points at once.

/// Deflection, rotations and q = 2 A a theta, point by point.
template <typename Real>
struct Fields {
  const Real *w, *x, *y, *q;
};
template <typename Real>
struct ForceFields {
  Real *force, *couple_x, *couple_y;
};

/// sum of D_kj m . (theta_j - theta_k) over pairs and single bonds.
template <typename Real, std::size_t N>
Lanes<Real, N> dilatation(const Following<Real, N>& place, const RowPattern<Real>& pattern, const Fields<Real>& in) {
  using Vector = Lanes<Real, N>;
  Vector sum = Vector::constant(0);
  for (const auto& pair : pattern.pairs) {
    sum += pair.Dx * (place.load(in.x, pair.plus) - place.load(in.x, pair.minus));
    sum += pair.Dy * (place.load(in.y, pair.plus) - place.load(in.y, pair.minus));
  }
  const Vector own_x = place.load(in.x), own_y = place.load(in.y);
  for (const auto& bond : pattern.singles) {
    sum += bond.Dx * (place.load(in.x, bond.step) - own_x);
    sum += bond.Dy * (place.load(in.y, bond.step) - own_y);
  }
  return sum;
}

template <typename Real, std::size_t N>
void force(const Following<Real, N>& place, const RowPattern<Real>& pattern, const Fields<Real>& in,
           const ForceFields<Real>& out) {
  using Vector = Lanes<Real, N>;
  const Vector own_w = place.load(in.w), own_x = place.load(in.x), own_y = place.load(in.y), own_q = place.load(in.q);
  Vector force = Vector::constant(0) - pattern.force_x * own_x - pattern.force_y * own_y;
  Vector couple_x = pattern.Dx * own_q - pattern.xx * own_x - pattern.xy * own_y;
  Vector couple_y = pattern.Dy * own_q - pattern.xy * own_x - pattern.yy * own_y;
  // deflections as differences to the point itself: exact where they are large
  for (const auto& p : pattern.pairs) {
    const Vector wp = place.load(in.w, p.plus) - own_w, wm = place.load(in.w, p.minus) - own_w;
    const Vector xp = place.load(in.x, p.plus), xm = place.load(in.x, p.minus);
    const Vector yp = place.load(in.y, p.plus), ym = place.load(in.y, p.minus);
    const Vector sum = p.mx * (xp + xm) + p.my * (yp + ym), turn = p.mx * (xp - xm) + p.my * (yp - ym);
    force += p.shear * (wp + wm - p.half_length * turn);
    const Vector couple =
        p.D_jk * (place.load(in.q, p.plus) - place.load(in.q, p.minus)) + p.bend * sum + p.g * (wp - wm);
    couple_x += p.mx * couple;
    couple_y += p.my * couple;
  }
  for (const auto& b : pattern.singles) {
    const Vector dw = place.load(in.w, b.step) - own_w;
    const Vector turn = b.mx * place.load(in.x, b.step) + b.my * place.load(in.y, b.step);
    force += b.shear * (dw - b.half_length * turn);
    const Vector couple = b.D_jk * place.load(in.q, b.step) + b.bend * turn + b.g * dw;
    couple_x += b.mx * couple;
    couple_y += b.my * couple;
  }
  place.store(force, out.force);
  place.store(couple_x, out.couple_x);
  place.store(couple_y, out.couple_y);
}

}  // namespace plate
