#include "plate/bonds/parameters/weights.hpp"

#include <string>
#include <unordered_map>

namespace plate {
namespace {

/// The family as a string of bytes: equal where bond vectors and areas are.
std::string key_of(const geometry::Families& families, const std::vector<double>& areas, bool active, std::size_t k) {
  std::string key(1, active ? '1' : '0');
  const auto append = [&key](const auto& value) { key.append(reinterpret_cast<const char*>(&value), sizeof value); };
  append(areas[k]);
  for (const auto& bond : families[k]) {
    append(bond.vector_id);
    append(areas[bond.neighbour]);
  }
  return key;
}

/// Has point k the family of the point before it?
bool alike(const geometry::Families& families, const std::vector<double>& areas, const std::vector<char>& active,
           std::size_t k) {
  if (families.pattern(k) != families.pattern(k - 1) || areas[k] != areas[k - 1] || active[k] != active[k - 1])
    return false;
  for (const auto& bond : families[k])
    if (areas[bond.neighbour] != areas[bond.neighbour - 1]) return false;
  return true;
}

}  // namespace

FamilyKinds family_kinds(const geometry::Families& families, const std::vector<double>& areas,
                         const std::vector<char>& active) {
  FamilyKinds result;
  result.kind.reserve(families.points());
  std::unordered_map<std::string, std::uint32_t> known;
  for (std::uint32_t k = 0; k < families.points(); ++k) {
    if (k > 0 && alike(families, areas, active, k)) {
      result.kind.push_back(result.kind.back());
      continue;
    }
    const auto [entry, fresh] =
        known.try_emplace(key_of(families, areas, active[k], k), static_cast<std::uint32_t>(known.size()));
    if (fresh) result.example.push_back(k);
    result.kind.push_back(entry->second);
  }
  return result;
}

HorizonWeights weights_of_parameters(const geometry::Families& families, const std::vector<BondShape>& shapes,
                                     const std::vector<double>& areas, const FamilyKinds& kinds,
                                     const std::vector<PointParameters>& parameters) {
  HorizonWeights result{kinds.kind, {}, {0}, {}};
  for (const auto k : kinds.example) {
    const PointParameters& p = parameters[k];
    result.a.push_back(p.a);
    for (const auto& bond : families[k]) {
      const double weighted = shapes[bond.vector_id].weight * areas[bond.neighbour];
      result.bonds.push_back({p.d * weighted, p.b * weighted, p.C / 4 * weighted});
    }
    result.first.push_back(result.bonds.size());
  }
  return result;
}

}  // namespace plate
