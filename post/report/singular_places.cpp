#include "post/report/singular_places.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/problem_validation.hpp"
#include "post/files/frame.hpp"
#include "post/report/probes_and_lines.hpp"

namespace post {
namespace {

using geometry::Point;

/// Corners at which plates have no finite stress (Williams 1952): those that point into the plate, those between a
/// clamped and a free edge of more than 60 degrees, and blunt ones of simply supported edges. Corners of less than 45
/// degrees from straight are edges that bend.
void add_corners(const geometry::Polygon& ring, bool outer, const plate::Problem& problem,
                 std::vector<SingularPlace>& found) {
  constexpr double straight = 180, bend = 45, least = 60, right = 95;  // [degrees]
  const auto holds = [&](const std::string& edge, bool clamped) {
    return std::ranges::any_of(problem.supports, [&](const plate::Support& support) {
      return !support.holds_nothing() && std::ranges::find(support.edges, edge) != support.edges.end() &&
             (!clamped || support.kind == plate::SupportKind::clamped);
    });
  };
  const auto count = ring.vertices.size();
  double area = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Point &a = ring.vertices[i], &b = ring.vertices[(i + 1) % count];
    area += a.x() * b.y() - a.y() * b.x();
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Point &at = ring.vertices[i], before = at - ring.vertices[(i + count - 1) % count],
                after = ring.vertices[(i + 1) % count] - at;
    const double turn = std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
    const double to_the_left = straight - (area > 0 ? 1 : -1) * turn * 180 / std::numbers::pi;  // inside of the ring
    const double angle = outer ? to_the_left : 360 - to_the_left;
    const auto &one = ring.edge_names[(i + count - 1) % count], &other = ring.edge_names[i];
    const bool loose = (holds(one, true) && !holds(other, false)) || (holds(other, true) && !holds(one, false));
    const bool simple = holds(one, false) && holds(other, false) && !holds(one, true) && !holds(other, true);
    if (angle > straight + bend || (loose && angle > least) || (simple && angle > right && angle < straight - bend))
      found.push_back({"corner", at});
  }
}

void add_supports(const plate::Formulation& plate, std::vector<SingularPlace>& found) {
  for (const auto& holder : plate.boundary().holders)
    if (holder.position && holder.kind != plate::SupportKind::hub) found.push_back({holder.name, *holder.position});
  for (const auto& support : plate.problem().supports)
    if (support.held_in_plane() != plate::InPlane::free)
      for (const auto& x : support.points) found.push_back({"pin in the plane", x});
}

}  // namespace

std::vector<SingularPlace> singular_places(const plate::Formulation& plate) {
  std::vector<SingularPlace> result;
  const auto& problem = plate.problem();
  add_corners(problem.outline.outer, true, problem, result);
  for (const auto& hole : problem.outline.holes)
    if (const auto* ring = std::get_if<geometry::Polygon>(&hole)) add_corners(*ring, false, problem, result);
  for (std::size_t i = 0; i < plate.tips().size(); ++i)
    result.push_back({fmt::format("tip {}", i), plate.tips()[i].position});
  add_supports(plate, result);
  for (const auto& load : problem.loads)
    if (const auto x = load.point()) result.push_back({"point force", *x});
  if (problem.impact) result.push_back({"impact", problem.impact->position});
  for (const auto& spring : problem.springs)
    if (spring.position) result.push_back({"spring", *spring.position});
  return result;
}

namespace {

/// Distance of the points about a place from each other [length].
double distance_of_points(const std::vector<plate::PlaceShare>& shares, const std::vector<Point>& positions) {
  double result = 0;
  for (const auto& one : shares)
    for (const auto& other : shares) result = std::max(result, (positions[one.point] - positions[other.point]).norm());
  return result / std::numbers::sqrt2;  // of the diagonal of a cell
}

}  // namespace

StressAround::StressAround(const plate::Formulation& plate, double distance) : distance_(distance) {
  constexpr std::size_t most = 50, directions = 32;
  constexpr double within = 0.999, same = 1e-9, points_on_way = 2;
  const auto places = singular_places(plate);
  for (const auto& place : places) {
    const auto known = [&](const Around& other) {
      return (other.place.position - place.position).norm() < same * distance;
    };
    if (around_.size() == most || std::ranges::any_of(around_, known)) continue;
    Around around{place, {}, true};
    for (std::size_t i = 0; i < directions; ++i) {
      const double angle = 2 * std::numbers::pi * double(i) / double(directions);
      const Point x = place.position + distance * Point(std::cos(angle), std::sin(angle));
      const auto near = [&](const SingularPlace& other) { return (x - other.position).norm() < within * distance; };
      if (!plate::on_plate(plate.problem().outline, x) || std::ranges::any_of(places, near)) continue;
      try {
        around.circle.push_back({place.name, x, place_in_frames(plate, x)});
      } catch (const plate::Refused&) {  // no points about it: the others tell
        continue;
      }
      const double apart = plate.offers(plate::Feature::horizon)
                               ? plate.discretization().spacing
                               : distance_of_points(around.circle.back().shares, plate.cloud().positions);
      around.resolved = around.resolved && points_on_way * apart <= distance;
    }
    if (!around.circle.empty()) around_.push_back(std::move(around));
  }
}

std::vector<StressAtDistance> StressAround::take(const Frame& frame) const {
  std::vector<StressAtDistance> result;
  for (const auto& [place, circle, resolved] : around_) {
    auto& one = result.emplace_back(
        StressAtDistance{.place = place.name, .singular = place.position, .distance = distance_, .resolved = resolved});
    for (const auto& at : circle) {
      double stress = 0;
      for (const auto& share : at.shares) stress += share.weight * frame.resultants.von_mises[share.point];
      if (stress > one.value) one.value = stress, one.position = at.position;
    }
  }
  return result;
}

}  // namespace post
