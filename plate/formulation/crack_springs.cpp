#include "plate/formulation/crack_springs.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "plate/model/errors.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/space.hpp"
#include "plate/model/wording.hpp"

namespace plate {
namespace {

using geometry::Point;
using Form = std::vector<FormTerm>;

/// Visits the points of both faces with their weights, minus on the right.
template <typename Visit>
void for_each(const FacePair& pair, const Visit& visit) {
  for (const auto& [point, weight] : pair.left) visit(point, weight);
  for (const auto& [point, weight] : pair.right) visit(point, -weight);
}

/// Jump of the displacement (u, v) along a direction, or of that of the fibre at z = 1.
Form jump_along(const FacePair& pair, const Point& direction) {
  Form result;
  for_each(pair, [&](std::uint32_t k, double weight) {
    result.push_back({dof(k, 2), weight * direction.x()});
    result.push_back({dof(k, 1), -weight * direction.y()});
  });
  return result;
}

Form jump_of_deflection(const FacePair& pair) {
  Form result;
  for_each(pair, [&](std::uint32_t k, double weight) { result.push_back({dof(k, 0), weight}); });
  return result;
}

Point along(const FacePair& pair) {
  return {-pair.normal.y(), pair.normal.x()};
}

double value(const Form& form, const State& state) {
  double result = 0;
  for (const auto& [at, factor] : form) result += factor * at_dof(state, at);
  return result;
}

/// Number of the crack that a place lies on, and that goes on there along a vector where cracks meet.
std::size_t crack_at(const std::vector<geometry::Polyline>& cracks, const Point& x, const Point& way) {
  const auto away = [&](const geometry::Polyline& crack) {
    return geometry::distance(crack, x) +
           std::min(geometry::distance(crack, x + way), geometry::distance(crack, x - way));
  };
  return std::size_t(std::ranges::min_element(cracks, {}, away) - cracks.begin());
}

/// Vector to the left of the way along a crack at a place on it.
Point left_at(const geometry::Polyline& crack, const Point& x) {
  std::size_t nearest = 0;
  double least = INFINITY;
  for (std::size_t i = 0; i + 1 < crack.size(); ++i)
    if (const double away = geometry::distance({crack[i], crack[i + 1]}, x); away < least) least = away, nearest = i;
  const Point way = crack[nearest + 1] - crack[nearest];
  return {-way.y(), way.x()};
}

/// Springs at a place of a crack through a part of the thickness. What does not open it is carried on.
void add_part(const Spring& spring, const Section& section, double depth, CrackSpring& result) {
  const double h = section.thickness, rigid = nearly_rigid * h;
  Section bends = section, stretches = section;
  bends.law = PlateLaw::bending, stretches.law = PlateLaw::membrane;
  const double twists = (1 - section.poisson) / 2;  // of the stiffness against bending or stretching
  result.part.emplace(section, depth, spring.from_below);
  result.opening = result.part->stiffness();
  result.deflection = bends.shear_stiffness() / rigid;
  result.tangential = twists * bends.bending_stiffness() / rigid;
  result.sliding = twists * stretches.bending_stiffness() / rigid;
}

}  // namespace

void CrackSpring::add(PlateLaw law, ElasticSupportSum& sum) const {
  const auto add = [&](double stiffness, const Form& form) {
    if (stiffness != 0) sum.add(pair.length * stiffness, form);
  };
  switch (law) {
    case PlateLaw::membrane:
      add(opening(0, 0), jump_along(pair, pair.normal));
      return add(sliding, jump_along(pair, along(pair)));
    case PlateLaw::coupling:
      return add(opening(0, 1), jump_along(pair, pair.normal));
    case PlateLaw::bending:
      add(deflection, jump_of_deflection(pair));
      add(opening(1, 1), jump_along(pair, pair.normal));
      return add(tangential, jump_along(pair, along(pair)));
  }
}

CarriedAcross CrackSpring::carried(const State& bending, const State& in_plane) const {
  const auto jump = [&](const State& state, const Point& direction) {
    return state.cols() > 0 ? value(jump_along(pair, direction), state) : 0;
  };
  CarriedAcross result;
  const Eigen::Vector2d opens(jump(in_plane, pair.normal), jump(bending, pair.normal)), carried = opening * opens;
  result.deflection = value(jump_of_deflection(pair), bending), result.rotation = opens[1];
  result.normal_force = carried[0], result.moment = carried[1];
  result.shear = deflection * result.deflection, result.twist = tangential * jump(bending, along(pair));
  result.tangential_force = sliding * jump(in_plane, along(pair));
  if (part) result.front_factor = part->front_factor(carried);
  return result;
}

std::vector<CrackSpring> crack_springs(const Problem& problem, std::size_t number, const std::vector<FacePair>& pairs) {
  const auto& spring = problem.springs[number];
  std::vector<CrackSpring> result;
  for (const auto& pair : pairs) {
    constexpr double little = 0.1;
    const auto crack = crack_at(problem.cracks, pair.position, little * pair.length * along(pair));
    if (std::ranges::find(spring.cracks, crack) == spring.cracks.end()) continue;
    auto& one = result.emplace_back(pair.seen_from(left_at(problem.cracks[crack], pair.position)));
    if (!spring.depth.given()) {
      one.deflection = spring.deflection, one.tangential = spring.rotation_tangential, one.sliding = spring.sliding;
      one.opening.diagonal() << spring.opening, spring.rotation_normal;
      continue;
    }
    const auto section = problem.section.at(pair.position);
    const double depth = spring.depth(pair.position), h = section.thickness;
    if (std::isnan(depth))
      throw Refused({{Subject::spring_depth, number, "is no number at " + text_of(pair.position)}});
    if (depth > PartThroughCrack::deepest * h)
      throw Refused({{Subject::spring_depth, number,
                      fmt::format("{:.4g} at {}: must be less than {:.2g} times the thickness {:.4g}", depth,
                                  text_of(pair.position), PartThroughCrack::deepest, h)}});
    add_part(spring, section, std::max(depth, 0.0), one);
  }
  return result;
}

bool part_through_at(const Problem& problem, const Point& x) {
  if (!problem.part_through()) return false;
  const auto crack = crack_at(problem.cracks, x, Point(0, 0));
  return std::ranges::any_of(problem.springs, [&](const Spring& one) {
    return one.depth.given() && std::ranges::find(one.cracks, crack) != one.cracks.end();
  });
}

}  // namespace plate
