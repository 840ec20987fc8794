#include "geometry/family_runs.hpp"

#include <map>

namespace geometry {
namespace {

/// The bonds of one point, relative to it.
std::vector<std::pair<std::uint32_t, std::int32_t>> pattern_of(const Families& families, std::uint32_t k) {
  std::vector<std::pair<std::uint32_t, std::int32_t>> pattern;
  for (auto b = families.first[k]; b < families.first[k + 1]; ++b)
    pattern.emplace_back(families.vector_id[b], static_cast<std::int32_t>(families.neighbour[b] - k));
  return pattern;
}

/// Does point k have the pattern of the point before it?
bool alike(const Families& families, std::uint32_t k) {
  const auto before = families.first[k - 1], own = families.first[k];
  const auto count = families.first[k + 1] - own;
  if (own - before != count) return false;
  for (std::size_t i = 0; i < count; ++i)
    if (families.vector_id[before + i] != families.vector_id[own + i] ||
        families.neighbour[before + i] + 1 != families.neighbour[own + i])
      return false;
  return true;
}

}  // namespace

FamilyRuns family_runs(const Families& families, std::uint32_t longest) {
  FamilyRuns result;
  result.pattern_first.push_back(0);
  std::map<std::vector<std::pair<std::uint32_t, std::int32_t>>, std::uint32_t> known;
  for (std::uint32_t k = 0; k < families.points(); ++k) {
    const bool same = k > 0 && alike(families, k);
    if (same && result.runs.back().length < longest) {
      ++result.runs.back().length;
      continue;
    }
    if (same) {
      result.runs.push_back({k, 1, result.runs.back().pattern});
      continue;
    }
    const auto pattern = pattern_of(families, k);
    const auto [entry, fresh] = known.try_emplace(pattern, static_cast<std::uint32_t>(known.size()));
    if (fresh) {
      for (const auto& [vector_id, step] : pattern) result.bonds.push_back({vector_id, step});
      result.pattern_first.push_back(result.bonds.size());
    }
    result.runs.push_back({k, 1, entry->second});
  }
  return result;
}

}  // namespace geometry
