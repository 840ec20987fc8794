#include "plate/formulation/face_pairs.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <ranges>

#include "geometry/cells/tessellation.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/reduction.hpp"

namespace plate {

using geometry::Point;

namespace {

/// Pairs of points that all ranks have found, in the order of the global plate: each rank knows those with an owned
/// point, and the owner of the left one tells the others where the pair is.
std::vector<FacePair> shared_pairs(const std::vector<FacePair>& seen, const PointMap& map) {
  struct Told {
    std::uint32_t left, right;  // global
    double position[2], normal[2], length;
  };
  std::vector<Told> own;
  for (const auto& pair : seen) {
    const auto left = pair.left.front().point, right = pair.right.front().point;
    if (map.owns(left))
      own.push_back({map.global[left],
                     map.global[right],
                     {pair.position.x(), pair.position.y()},
                     {pair.normal.x(), pair.normal.y()},
                     pair.length});
  }
  auto told = gathered(map, own);
  std::ranges::sort(told, {}, [](const Told& one) { return std::pair(one.left, one.right); });
  const auto shares = [&](std::uint32_t number) -> std::vector<FacePair::Share> {
    const auto found = std::ranges::lower_bound(map.global, number);
    if (found == map.global.end() || *found != number) return {};
    const auto here = std::uint32_t(found - map.global.begin());
    return map.owns(here) ? std::vector<FacePair::Share>{{here, 1}} : std::vector<FacePair::Share>();
  };
  std::vector<FacePair> result;
  for (const auto& one : told)
    result.push_back({.left = shares(one.left),
                      .right = shares(one.right),
                      .position = {one.position[0], one.position[1]},
                      .normal = {one.normal[0], one.normal[1]},
                      .length = one.length});
  return result;
}

}  // namespace

std::vector<FacePair> facing_points(const geometry::Tessellation& cells, const PointMap& map) {
  using Ends = std::array<double, 4>;
  const auto ends = [&](std::uint32_t from, std::uint32_t to) -> Ends {
    const auto &a = cells.positions[from], &b = cells.positions[to];
    return {a.x(), a.y(), b.x(), b.y()};
  };
  std::map<Ends, const geometry::Tessellation::Border*> faces;
  std::map<std::pair<std::uint32_t, std::uint32_t>, FacePair> found;  // by the points
  for (const auto& face : cells.borders) {
    if (face.edge >= 0) continue;
    const auto other = faces.find(ends(face.to, face.from));
    faces.emplace(ends(face.from, face.to), &face);
    if (other == faces.end()) continue;
    const Point side = cells.local[face.to] - cells.local[face.from];
    const auto take = [&](std::uint32_t left, std::uint32_t right) {
      if (left == right) return;
      const double sign = left < right ? 1 : -1;
      auto& pair = found[std::minmax(left, right)];
      pair.left = {{std::min(left, right), 1}}, pair.right = {{std::max(left, right), 1}};
      pair.position = cells.positions[pair.left.front().point];
      pair.normal += sign / 2 * Point(-side.y(), side.x());
      pair.length += side.norm() / 2;
    };
    take(face.from, other->second->to), take(face.to, other->second->from);
  }
  const bool alone = std::ranges::any_of(faces | std::views::values, [&](const auto* face) {
    return (map.owns(face->from) || map.owns(face->to)) && !faces.contains(ends(face->to, face->from));
  });
  if (largest_of(map, alone) > 0)
    throw NumericalError("faces of cracks: points of both faces do not lie at the same places: move the crack");
  std::vector<FacePair> result;
  for (auto& [points, pair] : found) pair.normal.normalize(), result.push_back(pair);
  return map.distributed() ? shared_pairs(result, map) : result;
}

}  // namespace plate
