#include "plate/bonds/lattice_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "geometry/lattice/cell_index.hpp"
#include "plate/model/algebra/dense.hpp"
#include "plate/model/refused.hpp"

namespace plate {
namespace {

using geometry::Point;

// All lengths in spacings. A point of a plate without corners is within half a diagonal of a cell, 0.71, of a point of
// the lattice; a right corner may be up to 1.7 away.
constexpr double largest_gap = 2;  // from the outline to the next point; a corner sharper than a right angle has more
constexpr double longest_spike = 10;  // that a sharp corner may lose
constexpr double largest_move = 1;    // of a pin or a force
constexpr double window = 12;         // distances beyond it are not told apart

/// Where the points are.
class Seeded {
public:
  explicit Seeded(const geometry::Cloud& cloud) : units_(cloud.units), lattice_(lattice_of(cloud)), index_(lattice_) {}

  /// From any place to the nearest point, at most `window` [spacings].
  double distance(const Point& u) const {
    double best = window;
    for (double ring = 0; ring <= std::min(best + 1, window); ++ring)
      for (double y = -ring; y <= ring; ++y)
        for (double x = -ring; x <= ring; x += std::abs(y) == ring ? 1 : 2 * ring)
          if (const auto k = index_.at(u + Point(x, y))) best = std::min(best, (lattice_[*k] - u).norm());
    return best;
  }
  double distance_from(const Point& x) const { return distance(units_.to_lattice(x)); }

private:
  static std::vector<Point> lattice_of(const geometry::Cloud& cloud) {
    std::vector<Point> result;
    for (std::size_t k = 0; k < cloud.plate_points; ++k) result.push_back(cloud.units.to_lattice(cloud.positions[k]));
    return result;
  }

  geometry::LatticeUnits units_;
  std::vector<Point> lattice_;
  geometry::CellIndex index_;
};

/// Places on the edges and holes called `name` (empty: on all), half a spacing apart, as far as all points about them
/// were seeded.
std::vector<Point> places(const geometry::Outline& cells, const std::string& name, const geometry::Cloud& cloud) {
  std::vector<Point> result;
  for (const auto& edge : geometry::straight_edges(cells)) {
    if (!name.empty() && edge.name != name) continue;
    const double count = std::ceil(2 * (edge.to - edge.from).norm());
    for (double i = 0; i <= count; ++i) result.push_back(edge.from + i / count * (edge.to - edge.from));
  }
  for (const auto& hole : cells.holes)
    if (const auto* circle = std::get_if<geometry::Circle>(&hole); circle && (name.empty() || circle->name == name)) {
      const double count = std::ceil(4 * std::numbers::pi * circle->radius);
      for (double i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        result.push_back(circle->centre + circle->radius * Point(std::cos(angle), std::sin(angle)));
      }
    }
  if (cloud.part)
    std::erase_if(result, [seen = cloud.part->grown(-long(window))](const Point& u) {
      return !seen.contains(geometry::cell_of(u));
    });
  return result;
}

/// A corner of the outline sharper than a right angle, and how far from it points may be missing.
struct Spike {
  Point corner;
  double length;
};

std::vector<Spike> spikes(const geometry::Outline& cells) {
  const auto& v = cells.outer.vertices;
  std::vector<Spike> result;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Point to = (v[(i + 1) % v.size()] - v[i]).normalized(),
                from = (v[(i + v.size() - 1) % v.size()] - v[i]).normalized();
    const bool convex = to.x() * from.y() - to.y() * from.x() > 0;
    const double half = std::acos(std::clamp(to.dot(from), -1.0, 1.0)) / 2;
    // a circle of 0.71 holds a point; in the corner it reaches as far as this
    if (convex && half < std::numbers::pi / 4)
      result.push_back({v[i], std::min(longest_spike, std::sqrt(0.5) * (1 + 1 / std::sin(half)))});
  }
  return result;
}

double allowed_gap(const std::vector<Spike>& sharp, const Point& u) {
  double result = largest_gap;
  for (const auto& spike : sharp)
    if ((u - spike.corner).norm() <= spike.length) result = std::max(result, spike.length);
  return result;
}

/// Parts of the plate that have no points.
void check_parts(const Problem& problem, const geometry::Cloud& cloud, const geometry::Outline& cells,
                 const Seeded& seeded, std::vector<Refusal>& refusals) {
  const auto sharp = spikes(cells);
  double furthest = 0;
  Point where(0, 0);
  for (const auto& u : places(cells, "", cloud))
    if (const double d = seeded.distance(u); d > allowed_gap(sharp, u) && d > furthest) furthest = d, where = u;
  if (furthest == 0) return;
  const Point x = cloud.units.from_lattice(where);
  double held = 0;
  for (std::size_t k = 0; k < cloud.plate_points; ++k) held += cloud.areas[k];
  const double all = geometry::area(problem.outline);
  refusals.push_back(
      {Subject::spacing, 0,
       fmt::format(
           "{:g} leaves out a part of the plate: ({:.6g}, {:.6g}) on its outline is {} spacings from the nearest "
           "point, and the cells of the points hold {:.4g} of its area of {:.4g}; parts no wider than a spacing "
           "have no points: refine, or choose formulation = \"galerkin\"",
           cloud.units.spacing, x.x(), x.y(),
           furthest < window ? fmt::format("{:.2g}", furthest) : fmt::format("over {:g}", window), held, all)});
}

void check_loaded_edges(const Problem& problem, const geometry::Cloud& cloud, const geometry::Outline& cells,
                        const Seeded& seeded, std::vector<Refusal>& refusals) {
  const auto check = [&](Subject subject, const char* what, const auto& all) {
    for (std::size_t i = 0; i < all.size(); ++i)
      for (const auto& name : all[i].edges) {
        const auto edge = places(cells, name, cloud);
        if (cloud.part && edge.empty()) continue;
        if (std::ranges::any_of(edge, [&](const auto& u) { return seeded.distance(u) < largest_gap - 0.5; })) continue;
        refusals.push_back(
            {subject, i,
             fmt::format("edge \"{}\" has no point of the lattice beside it that the {} could act on: refine", name,
                         what)});
      }
  };
  check(Subject::load_edges, "load", problem.loads);
  check(Subject::spring_edges, "spring", problem.springs);
}

/// Single places that would act somewhere else.
void check_places(const Problem& problem, const geometry::Cloud& cloud, const Seeded& seeded,
                  std::vector<Refusal>& refusals) {
  const auto cracks = geometry::to_lattice(crack_paths(problem), cloud.units);
  const auto check = [&](Subject subject, std::size_t number, const char* what, const Point& x) {
    if (!cloud.seeded(x)) return;
    if (const double away = seeded.distance_from(x); away > largest_move) {
      refusals.push_back({subject, number, too_far(what, x, away, largest_move)});
      return;
    }
    const Point u = cloud.units.to_lattice(x),
                nearest = cloud.units.to_lattice(cloud.positions[geometry::nearest_plate_point(cloud, x)]);
    if (std::ranges::any_of(cracks, [&](const auto& crack) { return geometry::severs(crack, u, nearest); }))
      refusals.push_back(
          {subject, number,
           fmt::format("a crack parts the {} at ({:g}, {:g}) from the nearest point of the lattice, which "
                       "would stand for it: refine, or choose formulation = \"galerkin\"",
                       what, x.x(), x.y())});
  };
  std::map<std::size_t, Point> pins;  // by the point that stands for them
  for (std::size_t i = 0; i < problem.supports.size(); ++i)
    for (const auto& x : problem.supports[i].points) {
      check(Subject::support_points, i, "pin", x);
      if (!cloud.seeded(x)) continue;
      const auto [other, alone] = pins.try_emplace(geometry::nearest_plate_point(cloud, x), x);
      if (!alone && other->second != x)
        refusals.push_back(
            {Subject::support_points, i,
             fmt::format("the pins at ({:g}, {:g}) and ({:g}, {:g}) are next to the same point of the "
                         "lattice, which can stand for one: refine, or choose formulation = \"galerkin\"",
                         other->second.x(), other->second.y(), x.x(), x.y())});
    }
  for (std::size_t i = 0; i < problem.loads.size(); ++i)
    if (problem.loads[i].kind == Load::Kind::point_force && !problem.loads[i].moves())
      check(Subject::load_position, i, "force", problem.loads[i].position);
  for (std::size_t i = 0; i < problem.springs.size(); ++i)
    if (const auto& at = problem.springs[i].position) check(Subject::spring_position, i, "spring", *at);
}

void check_held_lengths(const Problem& problem, const geometry::Outline& cells, std::vector<Refusal>& refusals) {
  const auto& supports = problem.supports;
  for (std::size_t i = 0; i < supports.size(); ++i) {
    if (!supports[i].holds_edges()) continue;
    double length = 0;
    for (const auto& name : supports[i].edges) length += geometry::edge_length(cells, name);
    if (length >= 1 - 1e-9) continue;
    refusals.push_back(
        {Subject::support_edges, i,
         fmt::format("acts on a length of {:.2g} spacings: bonds cannot hold a plate on less than one; refine, or "
                     "choose formulation = \"galerkin\"",
                     length)});
  }
}

/// Largest distance of the pins from the straight line through them that fits best.
double width(const std::vector<Point>& pins) {
  Point middle(0, 0);
  for (const auto& x : pins) middle += x / double(pins.size());
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const auto& x : pins) spread += (x - middle) * (x - middle).transpose();
  const Point across = eigenpairs(spread).vectors.col(0);
  double result = 0;
  for (const auto& x : pins) result = std::max(result, std::abs(across.dot(x - middle)));
  return result;
}

}  // namespace

std::string too_far(const std::string& what, const Point& x, double away, double most) {
  return fmt::format(
      "the {} at ({:g}, {:g}) is {:.2g} spacings from the nearest point of the lattice, which would stand for it: at "
      "most {:g}; refine, or choose formulation = \"galerkin\"",
      what, x.x(), x.y(), away, most);
}

std::optional<double> width_of_pins(const Problem& problem, const geometry::LatticeUnits& units) {
  const auto holds = [](const Support& s) {
    return s.holds_edges() || s.holds_inside() || s.kind == SupportKind::clamped;
  };
  if (problem.elastically_held() || std::ranges::any_of(problem.supports, holds)) return std::nullopt;
  std::vector<Point> pins;
  for (const auto& support : problem.supports)
    for (const auto& x : support.points) pins.push_back(units.to_lattice(x));
  if (pins.size() < 3) return std::nullopt;  // nothing holds the plate
  return width(pins);
}

void check_lattice(const Problem& problem, const geometry::Cloud& cloud, const geometry::Outline& cells) {
  const Seeded seeded(cloud);
  std::vector<Refusal> refusals;
  check_parts(problem, cloud, cells, seeded, refusals);
  check_loaded_edges(problem, cloud, cells, seeded, refusals);
  check_places(problem, cloud, seeded, refusals);
  check_held_lengths(problem, cells, refusals);
  if (!refusals.empty()) throw Refused(refusals);
}

double distance_to_points(const geometry::Cloud& cloud, const Point& x) {
  return Seeded(cloud).distance_from(x);
}

}  // namespace plate
