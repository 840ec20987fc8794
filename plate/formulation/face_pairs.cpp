#include "plate/formulation/face_pairs.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "geometry/cells/tessellation.hpp"
#include "plate/model/errors.hpp"

namespace plate {

using geometry::Point;

std::vector<FacePair> facing_points(const geometry::Tessellation& cells) {
  using Ends = std::array<double, 4>;
  const auto ends = [&](std::uint32_t from, std::uint32_t to) -> Ends {
    const auto &a = cells.positions[from], &b = cells.positions[to];
    return {a.x(), a.y(), b.x(), b.y()};
  };
  std::map<Ends, const geometry::Tessellation::Border*> faces;
  std::size_t matched = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, FacePair> found;  // by the points
  for (const auto& face : cells.borders) {
    if (face.edge >= 0) continue;
    const auto other = faces.find(ends(face.to, face.from));
    faces.emplace(ends(face.from, face.to), &face);
    if (other == faces.end()) continue;
    ++matched;
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
  if (faces.size() != 2 * matched)
    throw NumericalError("faces of cracks: points of both faces do not lie at the same places: move the crack");
  std::vector<FacePair> result;
  for (auto& [points, pair] : found) pair.normal.normalize(), result.push_back(pair);
  return result;
}

}  // namespace plate
