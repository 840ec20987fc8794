#include "plate/bonds/rows/gathered_points.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>

namespace plate {
namespace {

constexpr std::uint32_t none = std::uint32_t(-1);

using Key = std::vector<double>;

/// The bonds of a pattern turned to lie along a column, in lattice order; nothing where they are no lattice bonds.
std::optional<std::vector<std::pair<LatticeOffset, PatternBond>>> turned(std::span<const PatternBond> bonds,
                                                                         double spacing) {
  std::vector<std::pair<LatticeOffset, PatternBond>> result;
  for (PatternBond bond : bonds) {
    const double mx = bond.mx;
    bond.mx = bond.my, bond.my = -mx;
    const auto offset = lattice_offset(bond, spacing);
    if (!offset) return std::nullopt;
    result.emplace_back(*offset, bond);
  }
  std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return result;
}

class Finder {
public:
  Finder(const Patterns& patterns, const PointNumbers& numbers, double spacing, std::uint32_t farthest,
         std::int32_t pitch)
      : patterns_(patterns),
        pattern_of_(numbers.pattern_of),
        block_(numbers.block),
        spacing_(spacing),
        farthest_(farthest),
        pitch_(pitch),
        look_(pattern_of_.size(), none),
        taken_(pattern_of_.size(), 0) {}

  PointColumns columns(const std::vector<std::uint32_t>& points, std::uint32_t shortest, std::uint32_t longest) {
    for (const auto k : points) look_[k] = look(k);
    for (const auto k : points) {
      const auto below = look_[k] == none ? none : beside(k, -1);
      if (below != none && look_[below] == look_[k]) continue;  // of the column of the point below
      const auto chain = column_from(k);
      for (std::size_t i = 0; i < chain.size(); i += longest) {
        const std::vector<std::uint32_t> part(chain.begin() + std::ptrdiff_t(i),
                                              chain.begin() + std::ptrdiff_t(std::min(chain.size(), i + longest)));
        auto found = part.size() < shortest ? std::nullopt : column(part);
        if (found)
          result_.columns.push_back(std::move(*found));
        else
          result_.rest.insert(result_.rest.end(), part.begin(), part.end());
      }
    }
    for (const auto k : points)
      if (!taken_[k]) result_.rest.push_back(k);
    return std::move(result_);
  }

private:
  std::vector<std::uint32_t> column_from(std::uint32_t k) {
    std::vector<std::uint32_t> result;
    for (auto p = k; look_[k] != none && p != none && look_[p] == look_[k] && !taken_[p]; p = beside(p, 1))
      taken_[p] = 1, result.push_back(p);
    return result;
  }

  std::span<const PatternBond> bonds(std::uint32_t k) const { return patterns_.of(pattern_of_[k]); }

  /// The neighbour one spacing above or below, in the same block.
  std::uint32_t beside(std::uint32_t k, int up) const {
    for (const auto& bond : bonds(k))
      if (lattice_offset(bond, spacing_) == LatticeOffset{0, up}) {
        const auto j = std::uint32_t(std::int64_t(k) + bond.step);
        return block_.empty() || block_[j] == block_[k] ? j : none;
      }
    return none;
  }

  /// A number for the turned bonds of point k.
  std::uint32_t look(std::uint32_t k) {
    const auto list = turned(bonds(k), spacing_);
    if (!list || list->empty()) return none;
    const double stiffness = patterns_.stiffness[pattern_of_[k]];
    Key key{stiffness};
    for (const auto& [offset, bond] : *list) {
      if (std::uint32_t(std::max(std::abs(offset.i), std::abs(offset.j))) > farthest_) return none;
      key.insert(key.end(), {double(offset.i), double(offset.j), bond.D_kj, bond.D_jk, bond.curvature, bond.shear});
    }
    const auto [entry, fresh] = known_.try_emplace(std::move(key), std::uint32_t(known_.size()));
    if (fresh) {
      result_.patterns.push_back({{}, stiffness});
      for (auto [offset, bond] : *list) {
        bond.step = offset.j * pitch_ + offset.i;
        result_.patterns.back().bonds.push_back(bond);
      }
    }
    return entry->second;
  }

  /// Column of points; nothing where two points see different points in one place, as across two edges.
  std::optional<PointColumn> column(const std::vector<std::uint32_t>& points) const {
    PointColumn result{points, 0, look_[points.front()], {}};
    const auto first = *turned(bonds(points.front()), spacing_);
    for (const auto& [offset, bond] : first)
      result.reach = std::max({result.reach, std::uint32_t(std::abs(offset.i)), std::uint32_t(std::abs(offset.j))});
    const std::size_t width = points.size() + 2 * result.reach;
    result.sources.assign((2 * result.reach + 1) * width, none);
    const auto put = [&](std::size_t a, const LatticeOffset& o, std::uint32_t k) {
      auto& place = result.sources[std::size_t(o.j + std::int32_t(result.reach)) * width +
                                   std::size_t(std::int64_t(a + result.reach) + o.i)];
      const bool fits = place == none || place == k;
      place = k;
      return fits;
    };
    for (std::size_t a = 0; a < points.size(); ++a) {
      if (!put(a, {0, 0}, points[a])) return std::nullopt;
      const auto list = *turned(bonds(points[a]), spacing_);
      for (const auto& [offset, bond] : list)
        if (!put(a, offset, std::uint32_t(std::int64_t(points[a]) + bond.step))) return std::nullopt;
    }
    std::replace(result.sources.begin(), result.sources.end(), none, points.front());
    return result;
  }

  const Patterns& patterns_;
  const std::vector<std::uint32_t>&pattern_of_, &block_;
  double spacing_;
  std::uint32_t farthest_;
  std::int32_t pitch_;
  std::vector<std::uint32_t> look_;  // by point
  std::vector<char> taken_;          // by point
  std::map<Key, std::uint32_t> known_;
  PointColumns result_;
};

}  // namespace

PointColumns point_columns(const Patterns& patterns, const std::vector<std::uint32_t>& points,
                           const PointNumbers& numbers, double spacing, std::uint32_t shortest, std::uint32_t longest,
                           std::uint32_t farthest, std::int32_t pitch) {
  return Finder(patterns, numbers, spacing, farthest, pitch).columns(points, shortest, longest);
}

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
