#include "geometry/family_runs.hpp"

#include <map>

namespace geometry {
namespace {

/// Kind of point k, then step and kind of every neighbour.
std::vector<std::int64_t> pattern_of(const Families& families, const std::vector<std::uint32_t>& kind, std::uint32_t k) {
  std::vector<std::int64_t> pattern{kind[k]};
  for (auto b = families.first[k]; b < families.first[k + 1]; ++b) {
    pattern.push_back(std::int64_t(families.neighbour[b]) - std::int64_t(k));
    pattern.push_back(kind[families.neighbour[b]]);
  }
  return pattern;
}

/// Does point k have the pattern of the point before it?
bool alike(const Families& families, const std::vector<std::uint32_t>& kind, std::uint32_t k) {
  if (kind[k] != kind[k - 1]) return false;
  const auto before = families.first[k - 1], own = families.first[k];
  for (std::size_t i = 0; i < families.first[k + 1] - own; ++i) {
    const auto j = families.neighbour[own + i], j_before = families.neighbour[before + i];
    if (j_before + 1 != j || kind[j_before] != kind[j]) return false;
  }
  return true;
}

}  // namespace

FamilyRuns family_runs(const Families& families, const std::vector<std::uint32_t>& kind, std::uint32_t longest) {
  FamilyRuns result;
  std::map<std::vector<std::int64_t>, std::uint32_t> known;
  for (std::uint32_t k = 0; k < families.points(); ++k) {
    const bool same = k > 0 && alike(families, kind, k);
    if (same && result.runs.back().length < longest) {
      ++result.runs.back().length;
      continue;
    }
    if (same) {
      result.runs.push_back({k, 1, result.runs.back().pattern});
      continue;
    }
    const auto [entry, fresh] =
        known.try_emplace(pattern_of(families, kind, k), static_cast<std::uint32_t>(known.size()));
    if (fresh) result.example.push_back(k);
    result.runs.push_back({k, 1, entry->second});
  }
  return result;
}

}  // namespace geometry
