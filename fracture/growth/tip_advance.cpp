#include "fracture/growth/tip_advance.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace fracture {
namespace {

constexpr double least_leg = 5;    // spacings
constexpr double widest_gap = 7;   // spacings: more than the smallest ring needs
constexpr double small_turns = 5;  // times smaller, beside the long leg of another tip

}  // namespace

TipAdvance advance(const Growth& growth, const geometry::Outline& outline,
                   const std::vector<geometry::Polyline>& cracks, double spacing, const geometry::Tip& tip,
                   double angle, bool long_leg) {
  const geometry::Point direction = turns(long_leg ? small_turns * angle : angle)
                                        ? geometry::Point(Eigen::Rotation2Dd(angle) * tip.direction)
                                        : tip.direction;
  const double step = (long_leg ? std::max(growth.increment, least_leg) : growth.increment) * spacing;
  if (const auto ahead = geometry::obstacle_ahead(outline, cracks, tip, direction, step + least_leg * spacing))
    return {ahead->position, ahead->distance, ahead};
  return {tip.position + step * direction, step, {}};
}

std::optional<TipAdvance> break_through(const geometry::Outline& outline, const std::vector<geometry::Polyline>& cracks,
                                        double spacing, const geometry::Tip& tip) {
  const auto nearest = geometry::nearest_obstacle(outline, cracks, tip, widest_gap * spacing);
  return nearest ? std::optional(TipAdvance{nearest->position, nearest->distance, nearest}) : std::nullopt;
}

void meet_halfway(const std::vector<geometry::Tip>& tips, std::vector<std::optional<TipAdvance>>& ways) {
  const auto reaches = [&](std::size_t i, std::size_t j) {
    return ways[i] && ways[i]->reached && (ways[i]->to - tips[j].position).norm() <= 1e-9 * ways[i]->length;
  };
  for (std::size_t i = 0; i < tips.size(); ++i)
    for (std::size_t j = i + 1; j < tips.size(); ++j) {
      if (!reaches(i, j) || !reaches(j, i)) continue;
      const geometry::Point middle = (tips[i].position + tips[j].position) / 2;
      for (auto* way : {&*ways[i], &*ways[j]}) {
        way->to = middle, way->length /= 2;
        way->reached->position = middle, way->reached->distance = way->length;
      }
    }
}

std::string name_of(const geometry::Obstacle& obstacle) {
  return obstacle.crack ? "crack " + std::to_string(*obstacle.crack) : "'" + obstacle.name + "'";
}

}  // namespace fracture
