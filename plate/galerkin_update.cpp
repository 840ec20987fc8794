#include <algorithm>

#include "plate/galerkin_families.hpp"

namespace plate {
namespace {

using geometry::Families;
using geometry::Point;

/// Triangles of one cell with their shares, as in galerkin_families().
template <typename Visit>
void for_triangles(const geometry::CellParting& about, std::uint32_t cell, const Visit& visit) {
  const auto c = [&](std::size_t i) { return about.corner(cell, i); };
  if (about.corners(cell) == 3) return visit(std::array{c(0), c(1), c(2)}, 1.0);
  for (const auto& triangle :
       {std::array{c(0), c(1), c(2)}, {c(0), c(2), c(3)}, {c(0), c(1), c(3)}, {c(1), c(2), c(3)}})
    visit(triangle, 0.5);
}

/// The other corners of the cells about k, with the vectors that led to the places where they are.
std::vector<Families::Step> steps_of(const GalerkinFamilies& before, const geometry::CellParting& about,
                                     const std::vector<std::uint32_t>& origin, std::uint32_t k) {
  std::vector<std::uint32_t> members;
  for (const auto cell : about.cells_at(k))
    for (std::size_t c = 0; c < about.corners(cell); ++c)
      if (about.corner(cell, c) != k) members.push_back(about.corner(cell, c));
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
  const auto old = before.families[origin[k]];
  std::vector<Families::Step> steps;
  for (const auto j : members) steps.push_back({std::int32_t(j - k), old[old.find(origin[j])].vector_id});
  return steps;
}

/// V_k, and V_k G^k_i in `bonds`.
double mean_gradients(const geometry::Tessellation& cells, const geometry::CellParting& about, std::uint32_t k,
                      const Families::Family& family, GalerkinBond* bonds) {
  double area = 0;
  for (const auto cell : about.cells_at(k))
    for_triangles(about, cell, [&](const std::array<std::uint32_t, 3>& triangle, double share) {
      if (std::find(triangle.begin(), triangle.end(), k) == triangle.end()) return;
      const Point a = cells.local[triangle[0]], b = cells.local[triangle[1]], c = cells.local[triangle[2]];
      area += share / 6 * ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x());
      for (std::size_t i = 0; i < 3; ++i) {
        if (triangle[i] == k) continue;
        const Point side = cells.local[triangle[(i + 2) % 3]] - cells.local[triangle[(i + 1) % 3]];
        bonds[family.find(triangle[i])].gradient += share / 6 * Point(-side.y(), side.x());
      }
    });
  return area;
}

}  // namespace

void update(GalerkinFamilies& families, const geometry::Tessellation& cells, const geometry::CellParting& about,
            const geometry::Parting& parting) {
  const auto points = cells.local.size(), old_points = points - parting.origins.size();
  std::vector<std::uint32_t> origin(points);
  for (std::uint32_t k = 0; k < points; ++k) origin[k] = k < old_points ? k : parting.origins[k - old_points];
  std::vector<std::pair<std::uint32_t, std::vector<Families::Step>>> steps;
  for (const auto k : parting.touched) steps.emplace_back(k, steps_of(families, about, origin, k));
  for (const auto& [k, own] : steps) families.families.set(k, own);
  families.areas.resize(points);
  families.kind.resize(points);

  // a kind of its own, with room for its bonds, for every point whose weights change
  const auto own_kind = [&](std::uint32_t k, bool copied) {
    const auto count = families.families[k].size();
    std::vector<GalerkinBond> bonds(count, {Point(0, 0), 0});
    if (copied) std::copy_n(families.of(k), count, bonds.begin());
    families.kind[k] = std::uint32_t(families.first.size() - 1);
    families.bonds.insert(families.bonds.end(), bonds.begin(), bonds.end());
    families.first.push_back(families.bonds.size());
    return families.bonds.data() + families.first[families.kind[k]];
  };
  std::vector<std::uint32_t> shared = parting.touched;
  for (const auto k : parting.touched) {
    auto* const bonds = own_kind(k, false);
    const auto family = families.families[k];
    families.areas[k] = mean_gradients(cells, about, k, family, bonds);
    for (std::size_t i = 0; i < family.size(); ++i)
      bonds[i].gradient /= families.areas[k], shared.push_back(family[i].neighbour);
  }
  std::sort(shared.begin(), shared.end());
  shared.erase(std::unique(shared.begin(), shared.end()), shared.end());
  for (const auto k : shared) {
    const bool touched = std::binary_search(parting.touched.begin(), parting.touched.end(), k);
    auto* const bonds = touched ? families.bonds.data() + families.first[families.kind[k]] : own_kind(k, true);
    const auto family = families.families[k];
    double around = 0;
    for (const auto& bond : family) around += families.areas[bond.neighbour];
    for (std::size_t i = 0; i < family.size(); ++i)
      bonds[i].share = families.areas[k] * families.areas[family[i].neighbour] / around;
  }
}

}  // namespace plate
