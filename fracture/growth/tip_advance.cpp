#include "fracture/growth/tip_advance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "geometry/shape/predicates.hpp"

namespace fracture {
namespace {

constexpr double least_turn = std::numbers::pi / 180;
constexpr double not_known = std::numbers::pi / 6;  // error of a direction: a kink is up to 70 degrees
constexpr double slight = std::numbers::pi / 12;    // left away with a warning where it is not known

/// Energy release rates of unit factors, up to a common factor: of K1 or K2, and of K3.
struct Releases {
  double bending, shear;
};

Releases releases(const plate::Section& section) {
  return {12 / (section.young * std::pow(section.thickness, 3)),
          (1 + section.poisson) / (section.young * section.thickness) / section.shear_correction};
}

/// The place of the largest value in [-pi/2, pi/2]: of half-degree steps, then by golden section.
double largest(const std::function<double(double)>& value) {
  constexpr int steps = 180;
  constexpr double width = std::numbers::pi / steps, ratio = 0.6180339887498949;  // (sqrt(5) - 1) / 2
  double best = 0;
  for (int i = -steps / 2; i <= steps / 2; ++i)
    if (value(i * width) > value(best)) best = i * width;
  double low = best - width, high = best + width;
  while (high - low > 1e-10) {
    const double a = high - ratio * (high - low), b = low + ratio * (high - low);
    (value(a) > value(b) ? high : low) = value(a) > value(b) ? b : a;
  }
  return (low + high) / 2;
}

}  // namespace

Factors kinked(const Factors& f, double angle) {
  const double c = std::cos(angle / 2), s = std::sin(angle / 2);
  return {c * c * c * f.K1 - 3 * c * c * s * f.K2, c * c * s * f.K1 + c * (1 - 3 * s * s) * f.K2, c * f.K3};
}

double kink_angle(const Factors& f, Growth::Direction direction, const plate::Section& section) {
  // a tip that closes on one face opens on the other: the sign of the moments does not matter
  const Factors opening = f.K1 < 0 ? Factors{-f.K1, -f.K2, -f.K3} : f;
  switch (direction) {
    case Growth::Direction::straight:
      return 0;
    case Growth::Direction::tangential_moment:
      return opening.K2 == 0 ? 0 : largest([&](double angle) { return kinked(opening, angle).K1; });
    case Growth::Direction::energy_release: {
      const auto [bending, shear] = releases(section);
      return opening.K2 == 0 ? 0 : largest([&](double angle) {
        const Factors k = kinked(opening, angle);
        return bending * (k.K1 * k.K1 + k.K2 * k.K2) + shear * k.K3 * k.K3;
      });
    }
  }
  return 0;
}

double kink_error(const Factors& factors, const Factors& errors, Growth::Direction direction,
                  const plate::Section& section) {
  if (direction == Growth::Direction::straight) return 0;
  if (!std::isfinite(errors.K1) || !std::isfinite(errors.K2) || !std::isfinite(errors.K3)) return std::numbers::pi;
  const double angle = kink_angle(factors, direction, section);
  double result = 0;
  for (const double a : {-1, 1})
    for (const double b : {-1, 1})
      for (const double c : {-1, 1}) {
        const Factors off{factors.K1 + a * errors.K1, factors.K2 + b * errors.K2, factors.K3 + c * errors.K3};
        result = std::max(result, std::abs(kink_angle(off, direction, section) - angle));
        if (direction == Growth::Direction::tangential_moment) break;  // K3 does not matter
      }
  return result;
}

double release_error(const Factors& factors, const Factors& errors, const plate::Section& section) {
  if (!std::isfinite(errors.K1) || !std::isfinite(errors.K2) || !std::isfinite(errors.K3)) return INFINITY;
  const auto [bending, shear] = releases(section);
  const double whole = bending * (factors.K1 * factors.K1 + factors.K2 * factors.K2) + shear * factors.K3 * factors.K3;
  const double off = bending * (std::abs(factors.K1) * errors.K1 + std::abs(factors.K2) * errors.K2) +
                     shear * std::abs(factors.K3) * errors.K3;
  return whole > 0 ? off / whole : INFINITY;
}

bool turns(double angle) {
  return std::abs(angle) > least_turn;
}

bool Turn::known() const {
  return error <= not_known;
}

bool Turn::resolved() const {
  return known() || std::abs(asked) <= slight;
}

Turn turn_of(const Factors& factors, const Factors& errors, Growth::Direction direction, const plate::Section& section,
             double share) {
  const double angle = kink_angle(factors, direction, section);
  const double error = kink_error(factors, errors, direction, section);
  return {std::abs(angle) > share * error ? angle : 0, error, angle};
}

namespace {

constexpr double widest_gap = 7;   // spacings: more than the smallest ring needs
constexpr double small_turns = 5;  // times smaller, beside the long leg of another tip
constexpr double beside = 0.5;     // spacings: no points fit between cracks that are nearer
constexpr double touches = 1e-6;   // spacings: a way that is shorter is none

}  // namespace

TipAdvance advance(const Growth& growth, const geometry::Outline& outline,
                   const std::vector<geometry::Polyline>& cracks, double spacing, const geometry::Tip& tip,
                   double angle, bool long_leg, double leg) {
  const geometry::Point direction = turns(long_leg ? small_turns * angle : angle)
                                        ? geometry::Point(Eigen::Rotation2Dd(angle) * tip.direction)
                                        : tip.direction;
  const double least = (long_leg ? std::max(growth.increment, shortest_leg) : growth.increment) * spacing;
  double step = long_leg ? std::max(least, leg * spacing) : least;
  const double room = shortest_leg * spacing;
  if (const auto ahead = geometry::obstacle_ahead(outline, cracks, tip, direction, step + room, beside * spacing)) {
    if (ahead->distance <= least + room) return {ahead->position, ahead->distance, ahead};
    step = ahead->distance - room;
  }
  return {tip.position + step * direction, step, {}};
}

std::optional<TipAdvance> break_through(const geometry::Outline& outline, const std::vector<geometry::Polyline>& cracks,
                                        double spacing, const geometry::Tip& tip) {
  const auto nearest = geometry::nearest_obstacle(outline, cracks, tip, widest_gap * spacing);
  return nearest ? std::optional(TipAdvance{nearest->position, nearest->distance, nearest}) : std::nullopt;
}

namespace {

using geometry::Point;

/// Ends a way at a place on it or near it, where another crack ends too.
void end_at(TipAdvance& way, const geometry::Tip& from, const Point& place, std::size_t crack) {
  way.to = place, way.length = (place - from.position).norm();
  way.reached = geometry::Obstacle{way.length, place, "", crack};
}

/// Place where two ways meet: halfway between tips that reach each other, as none is before the other, or else where
/// the ways cross.
std::optional<Point> meeting(const geometry::Tip& tip, const TipAdvance& way, const geometry::Tip& other,
                             const TipAdvance& its) {
  const auto reaches = [](const TipAdvance& one, const geometry::Tip& end) {
    return one.reached && (one.to - end.position).norm() <= 1e-9 * one.length;
  };
  if (reaches(way, other) && reaches(its, tip)) return (tip.position + other.position) / 2;
  const Point step = way.to - tip.position, its_step = its.to - other.position, apart = other.position - tip.position;
  const double turn = geometry::cross(step, its_step);
  if (std::abs(turn) <= 1e-9 * way.length * its.length) return std::nullopt;
  const double share = geometry::cross(apart, its_step) / turn, its_share = geometry::cross(apart, step) / turn;
  constexpr double rounding = 1e-9;
  if (std::min(share, its_share) < -rounding || std::max(share, its_share) > 1 + rounding) return std::nullopt;
  return (tip.position + share * step + other.position + its_share * its_step) / 2;
}

}  // namespace

void meet(const std::vector<geometry::Tip>& tips, std::vector<std::optional<TipAdvance>>& ways) {
  struct Meeting {
    double gone;  // by both
    std::size_t i, j;
    Point place;
  };
  const auto distance = [&](std::size_t i, const Point& place) { return (place - tips[i].position).norm(); };
  std::vector<Meeting> found;
  for (std::size_t i = 0; i < tips.size(); ++i)
    for (std::size_t j = i + 1; j < tips.size(); ++j)
      if (ways[i] && ways[j])
        if (const auto place = meeting(tips[i], *ways[i], tips[j], *ways[j]))
          found.push_back({distance(i, *place) + distance(j, *place), i, j, *place});
  std::ranges::stable_sort(found, {}, &Meeting::gone);
  for (const auto& [gone, i, j, place] : found) {  // a tip that has ended before meets none any more
    constexpr double rounding = 1e-9;
    if (distance(i, place) > ways[i]->length * (1 + rounding) || distance(j, place) > ways[j]->length * (1 + rounding))
      continue;
    end_at(*ways[i], tips[i], place, tips[j].crack), end_at(*ways[j], tips[j], place, tips[i].crack);
  }
}

bool touches_at_once(const TipAdvance& way, double spacing) {
  return way.reached && way.length <= touches * spacing;
}

std::string name_of(const geometry::Obstacle& obstacle) {
  return obstacle.crack ? "crack " + std::to_string(*obstacle.crack) : "'" + obstacle.name + "'";
}

}  // namespace fracture
