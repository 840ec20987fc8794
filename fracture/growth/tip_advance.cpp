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

/// Energy release rates of unit factors, up to a common factor: of K1 or K2, of K3, and of N1 or N2.
struct Releases {
  double bending, shear, plane;

  double of(const Factors& f) const {
    return bending * (f.K1 * f.K1 + f.K2 * f.K2) + shear * f.K3 * f.K3 + plane * (f.N1 * f.N1 + f.N2 * f.N2);
  }
};

Releases releases(const plate::Section& section) {
  return {12 / (section.young * std::pow(section.thickness, 3)),
          (1 + section.poisson) / (section.young * section.thickness) / section.shear_correction,
          1 / (section.young * section.thickness)};
}

/// Moments with the stress that bending and membrane forces have together at a face, seen from there.
Factors at_face(const Factors& f, double thickness, int face) {
  const double arm = thickness / 6;
  return {face * f.K1 + arm * f.N1, face * f.K2 + arm * f.N2, face * f.K3};
}

bool all_known(const Factors& errors) {
  return std::isfinite(errors.K1) && std::isfinite(errors.K2) && std::isfinite(errors.K3) && std::isfinite(errors.N1) &&
         std::isfinite(errors.N2);
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
  const auto first = [&](double one, double two) { return c * c * c * one - 3 * c * c * s * two; };
  const auto second = [&](double one, double two) { return c * c * s * one + c * (1 - 3 * s * s) * two; };
  return {.K1 = first(f.K1, f.K2),
          .K2 = second(f.K1, f.K2),
          .K3 = c * f.K3,
          .N1 = first(f.N1, f.N2),
          .N2 = second(f.N1, f.N2)};
}

double energy_release(const Factors& factors, const plate::Section& section) {
  return std::numbers::pi * releases(section).of(factors);
}

bool pressed(const Factors& f, double thickness) {
  return f.N1 < 0 && std::abs(f.K1) <= -thickness / 6 * f.N1;
}

double size_of(const Factors& f, double thickness) {
  return std::hypot(std::hypot(f.K1, f.K2, f.K3 * thickness), thickness / 6 * std::hypot(f.N1, f.N2));
}

namespace {

/// The angle of the largest tension across [rad].
double tension_angle(const Factors& f) {
  return f.K2 == 0 ? 0 : largest([&](double angle) { return kinked(f, angle).K1; });
}

}  // namespace

int governing_face(const Factors& f, double thickness) {
  if (f.N1 == 0 && f.N2 == 0) return f.K1 < 0 ? -1 : 1;  // both faces have the same stress, with opposite signs
  const auto tension = [&](int face) {
    const auto stress = at_face(f, thickness, face);
    return kinked(stress, tension_angle(stress)).K1;
  };
  return tension(1) >= tension(-1) ? 1 : -1;
}

double kink_angle(const Factors& f, Growth::Direction direction, const plate::Section& section) {
  switch (direction) {
    case Growth::Direction::straight:
      return 0;
    case Growth::Direction::tangential_moment:
      // a tip that closes on one face may open on the other
      return tension_angle(at_face(f, section.thickness, governing_face(f, section.thickness)));
    case Growth::Direction::energy_release: {
      const auto released = releases(section);
      return f.K2 == 0 && f.N2 == 0 ? 0 : largest([&](double angle) { return released.of(kinked(f, angle)); });
    }
  }
  return 0;
}

double kink_error(const Factors& factors, const Factors& errors, Growth::Direction direction,
                  const plate::Section& section) {
  if (direction == Growth::Direction::straight) return 0;
  if (!all_known(errors)) return std::numbers::pi;
  const double angle = kink_angle(factors, direction, section);
  constexpr unsigned of_shear = 4, of_bending = 8, all = 32;  // signs of K1, K2, K3, N1, N2, one bit each
  double result = 0;
  for (unsigned signs = 0; signs < (errors.N1 == 0 && errors.N2 == 0 ? of_bending : all); ++signs) {
    if ((signs & of_shear) && direction == Growth::Direction::tangential_moment) continue;  // K3 does not matter
    const auto off = [&](unsigned bit, double factor, double error) {
      return factor + ((signs & bit) ? error : -error);
    };
    const Factors other{.K1 = off(1, factors.K1, errors.K1),
                        .K2 = off(2, factors.K2, errors.K2),
                        .K3 = off(of_shear, factors.K3, errors.K3),
                        .N1 = off(8, factors.N1, errors.N1),
                        .N2 = off(16, factors.N2, errors.N2)};
    result = std::max(result, std::abs(kink_angle(other, direction, section) - angle));
  }
  return result;
}

double release_error(const Factors& factors, const Factors& errors, const plate::Section& section) {
  if (!all_known(errors)) return INFINITY;
  const auto [bending, shear, plane] = releases(section);
  const double whole = releases(section).of(factors);
  const double off = bending * (std::abs(factors.K1) * errors.K1 + std::abs(factors.K2) * errors.K2) +
                     shear * std::abs(factors.K3) * errors.K3 +
                     plane * (std::abs(factors.N1) * errors.N1 + std::abs(factors.N2) * errors.N2);
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

void end_at_longest(const Growth& growth, const std::vector<geometry::Polyline>& cracks, double spacing,
                    const std::vector<geometry::Tip>& tips, std::vector<std::optional<TipAdvance>>& ways) {
  if (!growth.max_length) return;
  std::vector<double> gone(cracks.size());
  for (std::size_t i = 0; i < ways.size(); ++i)
    if (ways[i]) gone[tips[i].crack] += ways[i]->length;
  const double room = shortest_leg * spacing;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    if (!ways[i]) continue;
    const double left = *growth.max_length - geometry::length(cracks[tips[i].crack]);
    const double share = left / gone[tips[i].crack];
    if (!(share < 1)) continue;
    auto& way = *ways[i];
    const Point direction = (way.to - tips[i].position) / way.length;
    const bool turned = std::abs(geometry::cross(tips[i].direction, direction)) > 1e-9;
    const double length = std::min(way.length, std::max(share * way.length, turned ? room : 0));
    if (way.reached && way.length - length < room) continue;
    way = {tips[i].position + length * direction, length, {}};
  }
}

bool touches_at_once(const TipAdvance& way, double spacing) {
  return way.reached && way.length <= touches * spacing;
}

std::string name_of(const geometry::Obstacle& obstacle) {
  return obstacle.crack ? "crack " + std::to_string(*obstacle.crack) : "'" + obstacle.name + "'";
}

}  // namespace fracture
