#include "plate/bonds/rows/packets.hpp"

#include <algorithm>

namespace plate {

template <typename Real>
void Packets<Real>::add(const Patterns& patterns, std::vector<std::uint32_t> points,
                        const std::vector<std::uint32_t>& pattern_of) {
  const auto bonds = [&](std::uint32_t k) { return patterns.first[pattern_of[k] + 1] - patterns.first[pattern_of[k]]; };
  // packets of points with about as many bonds
  std::stable_sort(points.begin(), points.end(), [&](auto a, auto b) { return bonds(a) > bonds(b); });
  for (std::size_t begin = 0; begin < points.size(); begin += lanes) {
    Packet result{{}, std::uint32_t(std::min(lanes, points.size() - begin)), {}, bonds_.size(), 0};
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      result.point[lane] = points[begin + std::min<std::size_t>(lane, result.used - 1)];
      result.stiffness[lane] = Real(patterns.stiffness[pattern_of[result.point[lane]]]);
    }
    for (std::size_t i = 0; i < bonds(points[begin]); ++i) {
      Bond bond{};
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const auto k = result.point[lane];
        bond.neighbour[lane] = k;  // a bond to itself without weight where it has no other
        if (i >= bonds(k)) continue;
        const PatternBond& one = patterns.bonds[patterns.first[pattern_of[k]] + i];
        bond.mx[lane] = Real(one.mx), bond.my[lane] = Real(one.my), bond.half_length[lane] = Real(one.length / 2);
        bond.D_kj[lane] = Real(one.D_kj), bond.D_jk[lane] = Real(one.D_jk);
        bond.curvature[lane] = Real(one.curvature), bond.shear[lane] = Real(one.shear);
        bond.neighbour[lane] = std::uint32_t(std::int64_t(k) + one.step);
      }
      bonds_.push_back(bond);
    }
    result.end = bonds_.size();
    packets_.push_back(result);
  }
}

template <typename Real>
void Packets<Real>::dilatation(std::size_t i, const Fields<Real>& in, Real* q) const {
  const Packet& p = packets_[i];
  const Lane<Real> own_x = gather(in.x, p.point), own_y = gather(in.y, p.point);
  Lane<Real> sum = 0;
  for (std::size_t b = p.first; b < p.end; ++b) {
    const Bond& bond = bonds_[b];
    const auto table = [](const Real* values) { return Lane<Real>(values, simd::element_aligned); };
    sum += table(bond.D_kj) * (table(bond.mx) * (gather(in.x, bond.neighbour) - own_x) +
                               table(bond.my) * (gather(in.y, bond.neighbour) - own_y));
  }
  for (std::size_t lane = 0; lane < p.used; ++lane) q[p.point[lane]] = p.stiffness[lane] * sum[lane];
}

template <typename Real>
void Packets<Real>::force(std::size_t i, const Fields<Real>& in, const ForceFields<Real>& out) const {
  const Packet& p = packets_[i];
  const Lane<Real> own_w = gather(in.w, p.point), own_x = gather(in.x, p.point), own_y = gather(in.y, p.point),
                   own_q = gather(in.q, p.point);
  Lane<Real> force = 0, couple_x = 0, couple_y = 0;
  const auto table = [](const Real* values) { return Lane<Real>(values, simd::element_aligned); };
  for (std::size_t b = p.first; b < p.end; ++b) {
    const Bond& bond = bonds_[b];
    const auto* const j = bond.neighbour;
    const Lane<Real> mx = table(bond.mx), my = table(bond.my), half = table(bond.half_length);
    const Lane<Real> x_j = gather(in.x, j), y_j = gather(in.y, j);
    const Lane<Real> curvature = mx * (x_j - own_x) + my * (y_j - own_y);
    const Lane<Real> shear =
        table(bond.shear) * (gather(in.w, j) - own_w - half * (mx * (x_j + own_x) + my * (y_j + own_y)));
    const Lane<Real> couple = table(bond.D_kj) * own_q + table(bond.D_jk) * gather(in.q, j) +
                              table(bond.curvature) * curvature + half * shear;
    force += shear;
    couple_x += mx * couple;
    couple_y += my * couple;
  }
  for (std::size_t lane = 0; lane < p.used; ++lane) {
    const auto k = p.point[lane];
    out.force[k] = force[lane], out.couple_x[k] = couple_x[lane], out.couple_y[k] = couple_y[lane];
  }
}

template class Packets<double>;
template class Packets<float>;

}  // namespace plate
