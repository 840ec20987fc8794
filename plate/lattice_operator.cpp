#include "plate/lattice_operator.hpp"

#include <algorithm>
#include <cmath>

#include "plate/lanes.hpp"

namespace plate {
namespace {

bool equal(double a, double b) {
  return std::abs(a - b) <= 1e-13 * (std::abs(a) + std::abs(b));
}

/// Is b the mirror image of a in the point that has them both?
bool opposite(const PatternBond& a, const PatternBond& b) {
  return std::abs(a.mx + b.mx) < 1e-12 && std::abs(a.my + b.my) < 1e-12 && equal(a.length, b.length) &&
         equal(a.D_kj, b.D_kj) && equal(a.D_jk, b.D_jk) && equal(a.curvature, b.curvature) && equal(a.shear, b.shear);
}

}  // namespace

LatticeOperator::LatticeOperator(FamilyOperator plate)
    : FamilyOperator(std::move(plate)), row_pattern_index_(patterns().first.size() - 1, -1) {
  q_.setZero(Eigen::Index(points()));
  add_rows();
  Loose loose;
  for (const auto& run : runs().runs)
    for (std::uint32_t i = 0; run.length < Lane::size() && i < run.length; ++i)
      loose.emplace_back(run.first_point + i, run.pattern);
  add_packets(std::move(loose));
}

std::uint32_t LatticeOperator::row_pattern_of(std::uint32_t pattern) {
  auto& index = row_pattern_index_[pattern];
  if (index < 0) {
    index = std::int64_t(row_patterns_.size());
    const PatternBond* const bonds = patterns().bonds.data();
    row_patterns_.push_back(row_pattern(bonds + patterns().first[pattern], bonds + patterns().first[pattern + 1]));
  }
  return std::uint32_t(index);
}

void LatticeOperator::add_rows() {
  std::size_t paired = 0, in_rows = 0;
  for (const auto& run : runs().runs) {
    if (run.length < Lane::size()) continue;
    rows_.push_back({run.first_point, run.length, row_pattern_of(run.pattern)});
    in_rows += run.length;
    if (row_patterns_[rows_.back().pattern].singles.empty()) paired += run.length;
  }
  const double all = std::max<double>(1, double(points()));
  paired_share_ = double(paired) / all, row_share_ = double(in_rows) / all;
}

void LatticeOperator::add_packets(Loose points) {
  std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  Loose rest;
  for (std::size_t begin = 0, end; begin < points.size(); begin = end) {
    end = begin;
    while (end < points.size() && points[end].second == points[begin].second) ++end;
    std::size_t i = begin;
    for (; i + packet / 2 <= end; i += packet) {
      Packet one{{}, std::uint32_t(std::min(packet, end - i)), row_pattern_of(points[i].second)};
      for (std::size_t lane = 0; lane < packet; ++lane) one.point[lane] = points[std::min(i + lane, end - 1)].first;
      packets_.push_back(one);
    }
    for (; i < end; ++i) rest.push_back(points[i]);
  }
  // packets of points with about as many bonds
  const auto bonds_of = [&](const auto& entry) {
    return patterns().first[entry.second + 1] - patterns().first[entry.second];
  };
  std::stable_sort(rest.begin(), rest.end(), [&](const auto& a, const auto& b) { return bonds_of(a) > bonds_of(b); });
  for (std::size_t i = 0; i < rest.size(); i += packet)
    add_mixed({rest.begin() + std::ptrdiff_t(i), rest.begin() + std::ptrdiff_t(std::min(i + packet, rest.size()))});
}

LatticeOperator::RowPattern LatticeOperator::row_pattern(const PatternBond* begin, const PatternBond* end) const {
  RowPattern result;
  std::vector<char> done(std::size_t(end - begin), 0);
  for (const PatternBond* a = begin; a < end; ++a) {
    if (done[std::size_t(a - begin)]) continue;
    const double half = a->length / 2, g = a->shear * half, bend = a->curvature - g * half;
    const PatternBond* b = std::find_if(a + 1, end, [&](const PatternBond& other) { return opposite(*a, other); });
    const bool paired = b < end && !done[std::size_t(b - begin)];
    const double own = (paired ? 2 : 1) * (a->curvature + g * half);
    result.xx += own * a->mx * a->mx, result.xy += own * a->mx * a->my, result.yy += own * a->my * a->my;
    if (paired) {
      done[std::size_t(b - begin)] = 1;
      result.pairs.push_back(
          {a->mx, a->my, half, a->D_kj * a->mx, a->D_kj * a->my, a->D_jk, a->shear, bend, g, a->step, b->step});
      continue;
    }
    result.singles.push_back(
        {a->mx, a->my, half, a->D_kj * a->mx, a->D_kj * a->my, a->D_jk, a->shear, bend, g, a->step});
    result.Dx += a->D_kj * a->mx, result.Dy += a->D_kj * a->my;
    result.force_x += g * a->mx, result.force_y += g * a->my;
  }
  return result;
}

void LatticeOperator::add_mixed(const Loose& points) {
  MixedPacket result{{}, std::uint32_t(points.size()), mixed_bonds_.size(), 0};
  std::size_t longest = 0;
  for (std::size_t lane = 0; lane < packet; ++lane) {
    const auto& [point, pattern] = points[std::min(lane, points.size() - 1)];
    result.point[lane] = point;
    longest = std::max(longest, patterns().first[pattern + 1] - patterns().first[pattern]);
  }
  for (std::size_t i = 0; i < longest; ++i) {
    MixedBond bond{};
    for (std::size_t lane = 0; lane < packet; ++lane) {
      bond.neighbour[lane] = result.point[lane];  // a bond to itself without weight where it has no other
      const auto pattern = points[std::min(lane, points.size() - 1)].second;
      const std::size_t b = patterns().first[pattern] + i;
      if (b >= patterns().first[pattern + 1]) continue;
      const PatternBond& one = patterns().bonds[b];
      bond.mx[lane] = one.mx, bond.my[lane] = one.my, bond.half_length[lane] = one.length / 2;
      bond.D_kj[lane] = one.D_kj, bond.D_jk[lane] = one.D_jk;
      bond.curvature[lane] = one.curvature, bond.shear[lane] = one.shear;
      bond.neighbour[lane] = std::uint32_t(std::int64_t(result.point[lane]) + one.step);
    }
    mixed_bonds_.push_back(bond);
  }
  result.end = mixed_bonds_.size();
  mixed_.push_back(result);
}

template <typename Place>
void LatticeOperator::dilatation(const Place& place, const RowPattern& pattern, const State& state) const {
  using Vector = typename Place::Vector;
  const double* const x = state.data() + state.cols();
  const double* const y = x + state.cols();
  Vector sum = Vector::constant(0);
  for (const Pair& pair : pattern.pairs) {
    sum += pair.Dx * (place.load(x, pair.plus) - place.load(x, pair.minus));
    sum += pair.Dy * (place.load(y, pair.plus) - place.load(y, pair.minus));
  }
  const Vector own_x = place.load(x), own_y = place.load(y);
  for (const Single& bond : pattern.singles) {
    sum += bond.Dx * (place.load(x, bond.step) - own_x);
    sum += bond.Dy * (place.load(y, bond.step) - own_y);
  }
  place.store(place.load(dilatation_stiffness().data()) * sum, q_.data());
}

template <typename Place>
void LatticeOperator::force(const Place& place, const RowPattern& pattern, const State& state, Forces& forces) const {
  using Vector = typename Place::Vector;
  const Eigen::Index count = state.cols();
  const double* const w = state.data();
  const double* const x = w + count;
  const double* const y = x + count;
  const double* const q = q_.data();
  const Vector own_w = place.load(w), own_x = place.load(x), own_y = place.load(y), own_q = place.load(q);
  Vector force = Vector::constant(0) - pattern.force_x * own_x - pattern.force_y * own_y;
  Vector couple_x = pattern.Dx * own_q - pattern.xx * own_x - pattern.xy * own_y;
  Vector couple_y = pattern.Dy * own_q - pattern.xy * own_x - pattern.yy * own_y;
  // deflections as differences to the point itself: exact where they are large
  for (const Pair& p : pattern.pairs) {
    const Vector wp = place.load(w, p.plus) - own_w, wm = place.load(w, p.minus) - own_w;
    const Vector xp = place.load(x, p.plus), xm = place.load(x, p.minus);
    const Vector yp = place.load(y, p.plus), ym = place.load(y, p.minus);
    const Vector sum = p.mx * (xp + xm) + p.my * (yp + ym), turn = p.mx * (xp - xm) + p.my * (yp - ym);
    force += p.shear * (wp + wm - p.half_length * turn);
    const Vector couple = p.D_jk * (place.load(q, p.plus) - place.load(q, p.minus)) + p.bend * sum + p.g * (wp - wm);
    couple_x += p.mx * couple;
    couple_y += p.my * couple;
  }
  for (const Single& b : pattern.singles) {
    const Vector dw = place.load(w, b.step) - own_w;
    const Vector turn = b.mx * place.load(x, b.step) + b.my * place.load(y, b.step);
    force += b.shear * (dw - b.half_length * turn);
    const Vector couple = b.D_jk * place.load(q, b.step) + b.bend * turn + b.g * dw;
    couple_x += b.mx * couple;
    couple_y += b.my * couple;
  }
  place.store(force, forces.data());
  place.store(couple_x, forces.data() + count);
  place.store(couple_y, forces.data() + 2 * count);
}

void LatticeOperator::mixed_dilatation(const MixedPacket& p, const State& state) const {
  const Scattered place{p.point, p.used};
  const double* const x = state.data() + state.cols();
  const double* const y = x + state.cols();
  const auto own_x = place.load(x).part[0], own_y = place.load(y).part[0];
  Lanes<1> sum = Lanes<1>::constant(0);
  for (std::size_t b = p.first; b < p.end; ++b) {
    const MixedBond& bond = mixed_bonds_[b];
    const Lane mx(bond.mx, simd::element_aligned), my(bond.my, simd::element_aligned),
        D(bond.D_kj, simd::element_aligned);
    sum.part[0] += D * (mx * (gather(x, bond.neighbour, 0) - own_x) + my * (gather(y, bond.neighbour, 0) - own_y));
  }
  place.store(place.load(dilatation_stiffness().data()) * sum, q_.data());
}

void LatticeOperator::mixed_force(const MixedPacket& p, const State& state, Forces& forces) const {
  const Scattered place{p.point, p.used};
  const Eigen::Index count = state.cols();
  const double* const w = state.data();
  const double* const x = w + count;
  const double* const y = x + count;
  const Lane own_w = place.load(w).part[0], own_x = place.load(x).part[0], own_y = place.load(y).part[0];
  const Lane own_q = place.load(q_.data()).part[0];
  Lane force = 0, couple_x = 0, couple_y = 0;
  const auto table = [](const double* values) { return Lane(values, simd::element_aligned); };
  for (std::size_t b = p.first; b < p.end; ++b) {
    const MixedBond& bond = mixed_bonds_[b];
    const auto* const j = bond.neighbour;
    const Lane mx = table(bond.mx), my = table(bond.my), half = table(bond.half_length);
    const Lane x_j = gather(x, j, 0), y_j = gather(y, j, 0);
    const Lane curvature = mx * (x_j - own_x) + my * (y_j - own_y);
    const Lane shear = table(bond.shear) * (gather(w, j, 0) - own_w - half * (mx * (x_j + own_x) + my * (y_j + own_y)));
    const Lane couple = table(bond.D_kj) * own_q + table(bond.D_jk) * gather(q_.data(), j, 0) +
                        table(bond.curvature) * curvature + half * shear;
    force += shear;
    couple_x += mx * couple;
    couple_y += my * couple;
  }
  place.store({{force}}, forces.data());
  place.store({{couple_x}}, forces.data() + count);
  place.store({{couple_y}}, forces.data() + 2 * count);
}

void LatticeOperator::internal_force(const State& state, Forces& forces) const {
  forces.resize(3, state.cols());
#pragma omp parallel
  {
#pragma omp for schedule(static) nowait
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const RowPattern& pattern = row_patterns_[rows_[r].pattern];
      along(rows_[r].first, rows_[r].length, [&](auto place) { dilatation(place, pattern, state); });
    }
#pragma omp for schedule(static) nowait
    for (std::size_t p = 0; p < packets_.size(); ++p)
      dilatation(Scattered{packets_[p].point, packets_[p].used}, row_patterns_[packets_[p].pattern], state);
#pragma omp for schedule(static)
    for (std::size_t p = 0; p < mixed_.size(); ++p) mixed_dilatation(mixed_[p], state);
#pragma omp for schedule(static) nowait
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const RowPattern& pattern = row_patterns_[rows_[r].pattern];
      along(rows_[r].first, rows_[r].length, [&](auto place) { force(place, pattern, state, forces); });
    }
#pragma omp for schedule(static) nowait
    for (std::size_t p = 0; p < packets_.size(); ++p)
      force(Scattered{packets_[p].point, packets_[p].used}, row_patterns_[packets_[p].pattern], state, forces);
#pragma omp for schedule(static)
    for (std::size_t p = 0; p < mixed_.size(); ++p) mixed_force(mixed_[p], state, forces);
  }
}

std::size_t LatticeOperator::bytes() const {
  std::size_t sum = rows_.size() * sizeof(Row) + packets_.size() * sizeof(Packet) +
                    mixed_.size() * sizeof(MixedPacket) + mixed_bonds_.size() * sizeof(MixedBond) +
                    std::size_t(q_.size()) * sizeof(double);
  for (const auto& pattern : row_patterns_)
    sum += pattern.pairs.size() * sizeof(Pair) + pattern.singles.size() * sizeof(Single);
  return sum;
}

}  // namespace plate
