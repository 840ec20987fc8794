#include "geometry/lattice/family_runs.hpp"

#include <map>

namespace geometry {
namespace {

/// Kind of point k and pattern of its family, then the kind of every neighbour.
std::vector<std::uint32_t> look_of(const Families& families, const std::vector<std::uint32_t>& kind, std::uint32_t k) {
  std::vector<std::uint32_t> look{kind[k], families.pattern(k)};
  for (const auto& bond : families[k]) look.push_back(kind[bond.neighbour]);
  return look;
}

/// Does point k look like the point before it?
bool alike(const Families& families, const std::vector<std::uint32_t>& kind, std::uint32_t k) {
  if (kind[k] != kind[k - 1] || families.pattern(k) != families.pattern(k - 1)) return false;
  for (const auto& bond : families[k])
    if (kind[bond.neighbour] != kind[bond.neighbour - 1]) return false;
  return true;
}

}  // namespace

FamilyRuns family_runs(const Families& families, const std::vector<std::uint32_t>& kind, std::uint32_t longest,
                       const std::vector<std::uint32_t>& block) {
  FamilyRuns result;
  std::map<std::vector<std::uint32_t>, std::uint32_t> known;
  for (std::uint32_t k = 0; k < families.points(); ++k) {
    const bool same = k > 0 && alike(families, kind, k);
    const bool together = same && (block.empty() || block[k] == block[k - 1]);
    if (together && result.runs.back().length < longest) {
      ++result.runs.back().length;
      continue;
    }
    if (same) {
      result.runs.push_back({k, 1, result.runs.back().pattern});
      continue;
    }
    const auto [entry, fresh] = known.try_emplace(look_of(families, kind, k), static_cast<std::uint32_t>(known.size()));
    if (fresh) result.example.push_back(k);
    result.runs.push_back({k, 1, entry->second});
  }
  return result;
}

}  // namespace geometry
