#include "plate/bond_weights.hpp"

#include <string>
#include <unordered_map>

namespace plate {
namespace {

/// The family as a string of bytes: equal where bond vectors and areas are.
std::string key_of(const geometry::Families& families, const std::vector<double>& areas, bool active, std::size_t k) {
  std::string key(1, active ? '1' : '0');
  const auto append = [&key](const auto& value) {
    key.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  append(areas[k]);
  for (auto b = families.first[k]; b < families.first[k + 1]; ++b) {
    append(families.vector_id[b]);
    append(areas[families.neighbour[b]]);
  }
  return key;
}

}  // namespace

FamilyKinds family_kinds(const geometry::Families& families, const std::vector<double>& areas,
                         const std::vector<char>& active) {
  FamilyKinds result;
  result.kind.reserve(families.points());
  std::unordered_map<std::string, std::uint32_t> known;
  std::string before;
  for (std::uint32_t k = 0; k < families.points(); ++k) {
    auto key = key_of(families, areas, active[k], k);
    if (k > 0 && key == before) {
      result.kind.push_back(result.kind.back());
      continue;
    }
    const auto [entry, fresh] = known.try_emplace(key, static_cast<std::uint32_t>(known.size()));
    if (fresh) result.example.push_back(k);
    result.kind.push_back(entry->second);
    before = std::move(key);
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
    for (auto b = families.first[k]; b < families.first[k + 1]; ++b) {
      const double weighted = shapes[families.vector_id[b]].weight * areas[families.neighbour[b]];
      result.bonds.push_back({p.d * weighted, p.b * weighted, p.C / 4 * weighted});
    }
    result.first.push_back(result.bonds.size());
  }
  return result;
}

}  // namespace plate
