#pragma once
#include "plate/bonds/rows/pattern.hpp"
#include "plate/solve/lanes.hpp"

/// What a row of points with one pattern of bonds does: Dai 11-13 for a vector of points at once.
namespace plate {

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
