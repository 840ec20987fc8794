#include "fracture/growth/tip_advance.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace fracture {
namespace {

constexpr double least_turn = std::numbers::pi / 180;
constexpr double least_leg = 5;  // spacings

}  // namespace

bool turns(double angle) {
  return std::abs(angle) > least_turn;
}

TipAdvance advance(const Growth& growth, const geometry::Outline& outline,
                   const std::vector<geometry::Polyline>& cracks, double spacing, const geometry::Tip& tip,
                   double angle, bool long_leg) {
  const geometry::Point direction = std::abs(angle) > (long_leg ? least_turn / 5 : least_turn)
                                        ? geometry::Point(Eigen::Rotation2Dd(angle) * tip.direction)
                                        : tip.direction;
  const double step = (long_leg ? std::max(growth.increment, least_leg) : growth.increment) * spacing;
  if (const auto ahead = geometry::obstacle_ahead(outline, cracks, tip, direction, step + least_leg * spacing))
    return {ahead->position, ahead->distance, ahead};
  return {tip.position + step * direction, step, {}};
}

TipAdvance break_through(const geometry::Outline& outline, const std::vector<geometry::Polyline>& cracks,
                         const geometry::Tip& tip) {
  const auto nearest = geometry::nearest_obstacle(outline, cracks, tip);
  return {nearest.position, nearest.distance, nearest};
}

std::string name_of(const geometry::Obstacle& obstacle) {
  return obstacle.crack ? "crack " + std::to_string(*obstacle.crack) : "'" + obstacle.name + "'";
}

}  // namespace fracture
