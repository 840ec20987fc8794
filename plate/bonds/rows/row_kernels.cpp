#include "plate/bonds/rows/row_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "plate/bonds/rows/folded_row.hpp"

namespace plate {
namespace {

bool equal(double a, double b) {
  return std::abs(a - b) <= 1e-13 * (std::abs(a) + std::abs(b));
}

bool same_weights(const PatternBond& a, const PatternBond& b) {
  return equal(a.length, b.length) && equal(a.D_kj, b.D_kj) && equal(a.D_jk, b.D_jk) &&
         equal(a.curvature, b.curvature) && equal(a.shear, b.shear);
}

/// True where b is the mirror image of a in the point that has them both.
bool opposite(const PatternBond& a, const PatternBond& b) {
  return std::abs(a.mx + b.mx) < 1e-12 && std::abs(a.my + b.my) < 1e-12 && same_weights(a, b);
}

/// The couple of a bond is m (D q + bend (m . theta_j) + g (w_j - w_k) - own (m . theta_k)).
struct Couple {
  double half, g, bend, own;

  explicit Couple(const PatternBond& bond)
      : half(bond.length / 2), g(bond.shear * half), bend(bond.curvature - g * half), own(bond.curvature + g * half) {}
};

using Offsets = std::map<LatticeOffset, const PatternBond*>;

/// Steps to (0, j) for j = -reach ... reach where every bond (i, j) is i steps beside its row's.
std::optional<std::map<std::int32_t, std::int32_t>> row_steps(const Offsets& offsets) {
  std::map<std::int32_t, std::int32_t> result{{0, 0}};
  for (const auto& [offset, bond] : offsets)
    if (result.try_emplace(offset.j, bond->step - offset.i).first->second != bond->step - offset.i) return std::nullopt;
  return result;
}

bool own_mirror_image(const Offsets& offsets) {
  return std::all_of(offsets.begin(), offsets.end(), [&](const auto& entry) {
    const auto& [offset, bond] = entry;
    for (const LatticeOffset image : {LatticeOffset{-offset.i, offset.j}, {offset.i, -offset.j}}) {
      const auto other = offsets.find(image);
      if (other == offsets.end() || !same_weights(*bond, *other->second)) return false;
    }
    return true;
  });
}

int radius_squared(const Offsets& offsets) {
  int result = 0;
  for (const auto& [offset, bond] : offsets) result = std::max(result, offset.i * offset.i + offset.j * offset.j);
  return result;
}

template <typename Real>
typename RowPattern<Real>::Mirrored mirrored(const PatternBond& bond) {
  const Couple c(bond);
  const double mx = bond.mx, my = bond.my, turn = -bond.shear * c.half;
  return {Real(bond.D_kj * mx),   Real(bond.D_kj * my),   Real(bond.shear),     Real(turn * mx),
          Real(turn * my),        Real(bond.D_jk * mx),   Real(bond.D_jk * my), Real(c.bend * mx * mx),
          Real(c.bend * mx * my), Real(c.bend * my * my), Real(c.g * mx),       Real(c.g * my)};
}

template <typename Real>
std::optional<typename RowPattern<Real>::Fold> fold_of(std::span<const PatternBond> bonds, double spacing) {
  Offsets offsets;
  for (const auto& bond : bonds) {
    const auto offset = lattice_offset(bond, spacing);
    if (!offset) return std::nullopt;
    offsets[*offset] = &bond;
  }
  const auto steps = row_steps(offsets);
  if (!steps || offsets.size() < bonds.size() || bonds.empty() || !own_mirror_image(offsets)) return std::nullopt;
  const auto reach = disc_width(radius_squared(offsets), 0);
  if (steps->size() != 2 * std::size_t(reach) + 1 || steps->rbegin()->first != reach) return std::nullopt;
  typename RowPattern<Real>::Fold fold{radius_squared(offsets), {}, {}, {}, 0};
  if (!visit_disc(fold.radius_squared, [](auto) {})) return std::nullopt;
  double shear = 0;
  for (const auto& bond : bonds) shear += bond.shear;
  fold.shear = Real(shear);
  for (std::int32_t j = 0; j <= reach; ++j) {
    fold.up.push_back(steps->at(j)), fold.down.push_back(steps->at(-j));
    for (std::int32_t i = 0; i <= disc_width(fold.radius_squared, j); ++i) {
      const auto entry = offsets.find({i, j});
      if ((entry == offsets.end()) != (i == 0 && j == 0)) return std::nullopt;  // not a disc
      fold.bonds.push_back(entry == offsets.end() ? typename RowPattern<Real>::Mirrored{}
                                                  : mirrored<Real>(*entry->second));
    }
  }
  return fold;
}

template <typename Real>
void reach_of(RowPattern<Real>& pattern, std::span<const PatternBond> bonds) {
  const auto reads = [&](std::int64_t from, std::int64_t to) {
    pattern.lowest = std::min(pattern.lowest, from), pattern.highest = std::max(pattern.highest, to);
  };
  for (const auto& bond : bonds) reads(bond.step, bond.step);
  if (!pattern.fold) return;
  const auto beside = std::int64_t(pattern.fold->up.size()) - 1;  // columns of every row
  for (const auto step : {pattern.fold->up.back(), pattern.fold->down.back()}) reads(step - beside, step + beside);
}

}  // namespace

std::optional<LatticeOffset> lattice_offset(const PatternBond& bond, double spacing) {
  const double x = -bond.my * bond.length / spacing, y = bond.mx * bond.length / spacing;
  if (std::abs(x - std::round(x)) > 1e-6 || std::abs(y - std::round(y)) > 1e-6) return std::nullopt;
  return LatticeOffset{std::int32_t(std::lround(x)), std::int32_t(std::lround(y))};
}

template <typename Real>
RowPattern<Real> row_pattern(std::span<const PatternBond> bonds, double stiffness, std::optional<double> spacing) {
  RowPattern<Real> result;
  result.stiffness = Real(stiffness);
  if (spacing) result.fold = fold_of<Real>(bonds, *spacing);
  double xx = 0, xy = 0, yy = 0, Dx = 0, Dy = 0, force_x = 0, force_y = 0;
  std::vector<char> done(bonds.size(), 0);
  for (std::size_t n = 0; n < bonds.size(); ++n) {
    const PatternBond& a = bonds[n];
    const Couple c(a);
    xx += c.own * a.mx * a.mx, xy += c.own * a.mx * a.my, yy += c.own * a.my * a.my;
    if (done[n] || result.fold) continue;
    const auto b = std::find_if(bonds.begin() + std::ptrdiff_t(n) + 1, bonds.end(),
                                [&](const PatternBond& other) { return opposite(a, other); });
    if (b != bonds.end() && !done[std::size_t(b - bonds.begin())]) {
      done[std::size_t(b - bonds.begin())] = 1;
      result.pairs.push_back({Real(a.mx), Real(a.my), Real(c.half), Real(a.D_kj * a.mx), Real(a.D_kj * a.my),
                              Real(a.D_jk), Real(a.shear), Real(c.bend), Real(c.g), a.step, b->step});
      continue;
    }
    result.singles.push_back({Real(a.mx), Real(a.my), Real(c.half), Real(a.D_kj * a.mx), Real(a.D_kj * a.my),
                              Real(a.D_jk), Real(a.shear), Real(c.bend), Real(c.g), a.step});
    Dx += a.D_kj * a.mx, Dy += a.D_kj * a.my;
    force_x += c.g * a.mx, force_y += c.g * a.my;
  }
  result.xx = Real(xx), result.xy = Real(xy), result.yy = Real(yy);
  result.Dx = Real(Dx), result.Dy = Real(Dy), result.force_x = Real(force_x), result.force_y = Real(force_y);
  reach_of(result, bonds);
  return result;
}

template RowPattern<double> row_pattern<double>(std::span<const PatternBond>, double, std::optional<double>);
template RowPattern<float> row_pattern<float>(std::span<const PatternBond>, double, std::optional<double>);

}  // namespace plate
