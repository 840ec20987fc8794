#include "plate/bonds/validation.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "geometry/lattice/cloud.hpp"
#include "plate/bonds/horizon_parameters.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/model/dense_algebra.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/section.hpp"
#include "plate/model/supports.hpp"

namespace plate {
namespace {

using geometry::Point;

// All lengths in spacings. A point of a plate without corners is within half a diagonal of a cell, 0.71, of a point of
// the lattice; a right corner may be up to 1.7 away.
constexpr double largest_gap = 2;  // from the outline to the next point; a corner sharper than a right angle has more
constexpr double longest_spike = 10;  // that a sharp corner may lose
constexpr double largest_move = 1;    // of a pin or a force
constexpr double window = 12;         // distances beyond it are not told apart

/// Lattice of the points, for distances from any place to the nearest point.
class Seeded {
public:
  explicit Seeded(const geometry::Cloud& cloud) : units_(cloud.units), lattice_(lattice_of(cloud)), index_(lattice_) {}

  /// Distance from any place to the nearest point, at most `window` [spacings].
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
/// were discretised.
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
           "point, and points cover {:.4g} of its area {:.4g}; refine, or choose formulation = \"galerkin\"",
           cloud.units.spacing, x.x(), x.y(),
           furthest < window ? fmt::format("{:.2g}", furthest) : fmt::format("over {:g}", window), held, all)});
}

void check_loaded_edges(const Problem& problem, const geometry::Cloud& cloud, const geometry::Outline& cells,
                        const Seeded& seeded, std::vector<Refusal>& refusals) {
  const auto check = [&](Subject subject, std::size_t number, const char* what, const auto& edges) {
    for (const auto& name : edges) {
      const auto edge = places(cells, name, cloud);
      if (cloud.part && edge.empty()) continue;
      if (std::ranges::any_of(edge, [&](const auto& u) { return seeded.distance(u) < largest_gap - 0.5; })) continue;
      refusals.push_back(
          {subject, number,
           fmt::format("edge \"{}\" has no point of the lattice beside it that the {} could act on: refine", name,
                       what)});
    }
  };
  for (std::size_t i = 0; i < problem.loads.size(); ++i)
    check(Subject::load_edges, i, "load", problem.loads[i].edges());
  for (std::size_t i = 0; i < problem.springs.size(); ++i)
    check(Subject::spring_edges, i, "spring", problem.springs[i].edges);
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
    if (std::ranges::any_of(cracks, [&](const auto& crack) { return geometry::separates(crack, u, nearest); }))
      refusals.push_back(
          {subject, number,
           fmt::format("a crack parts the {} at ({:g}, {:g}) from the nearest point of the lattice, which "
                       "would stand for it: refine, or choose formulation = \"galerkin\"",
                       what, x.x(), x.y())});
  };
  std::map<std::size_t, Point> pins;  // by the point that stands for them
  for (std::size_t i = 0; i < problem.supports.size(); ++i)
    for (const auto& x : problem.supports[i].points) {
      if (problem.supports[i].holds_nothing()) continue;
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
    if (const auto position = problem.loads[i].point()) check(Subject::load_position, i, "force", *position);
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
  if (problem.elastically_supported() || std::ranges::any_of(problem.supports, holds)) return std::nullopt;
  std::vector<Point> pins;
  for (const auto& support : problem.supports)
    for (const auto& x : support.points)
      if (!support.holds_nothing()) pins.push_back(units.to_lattice(x));
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

namespace {

/// Bending that varies over the plate locks where the horizon is much larger than the thickness (theory (66)): beside
/// clamped edges and point forces up to twelve times as much as in the longest wave.
void check_thickness(const Formulation& plate, std::vector<std::string>& warnings) {
  const double h = plate.section().thickness, spacing = plate.discretization().spacing,
               horizon = plate.discretization().horizon();
  const double number = horizon / h * lowest_wave(plate) * horizon, locking = 0.0016 * number * number;
  constexpr double trusted = 2.5;  // 1 % by theory (66)
  if (number <= trusted) return;
  warnings.push_back(fmt::format(
      "thickness is 1/{:.3g} of the spacing: shear locking makes deflections some {:.2g} % too small, more beside "
      "clamped edges; set formulation = \"galerkin\"",
      spacing / h, 100 * locking / (1 + locking)));
}

/// Round holes and clamped edges on random plates, 14 to 48 spacings a side: 3 to 33 % below what is there, the median
/// 21 %; 100 spacings a side 9 %.
void check_stress(const Formulation& plate, std::vector<std::string>& warnings) {
  const auto& sides = plate.boundary().sides;
  const bool hole = !plate.problem().outline.holes.empty(),
             clamped = std::ranges::any_of(sides, [](const auto&side) { return side.kind == SupportKind::clamped; });
  if (!hole && !clamped) return;
  warnings.push_back(fmt::format("stress of bonds comes out 5 to 30 % too small at {}; set formulation = \"galerkin\"",
                                 !clamped ? "holes"
                                 : hole   ? "holes and clamped edges"
                                          : "clamped edges"));
}

/// Warns where points are too coarse for the layer beside free edges, soft supports and crack faces, within which twist
/// and shear change.
void check_edge_layer(const Formulation& plate, bool factors, std::vector<std::string>& warnings) {
  const double horizon = plate.discretization().horizon(), layer = plate.section().layer();
  const bool soft = std::ranges::any_of(plate.boundary().sides,
                                        [](const auto& side) { return side.kind == SupportKind::simply_supported; });
  if (horizon <= layer || (!soft && !factors)) return;
  warnings.push_back(
      fmt::format("horizon is {:.3g} times the edge layer: {} not resolved; set `spacing` = {:.2g} or "
                  "formulation = \"galerkin\"",
                  horizon / layer,
                  !soft     ? "K3 is"
                  : factors ? "K3 and soft supports are"
                            : "soft supports are",
                  layer / horizon * plate.discretization().spacing));
}

/// Relative error of the bending stiffness of the full lattice family: D11 / D - 1 (theory (16-18)).
double anisotropy(const Section& section, const Discretization& d) {
  double fourth = 0, twist = 0;
  for (const auto& xi : full_family(d)) {
    const double weight = influence(d.influence, xi.norm(), d.horizon()) * volume_share(d, xi);
    fourth += weight * std::pow(xi.x(), 4) / xi.squaredNorm();
    twist += weight * std::pow(xi.x() * xi.y(), 2) / xi.squaredNorm();
  }
  const double excess = fourth / (3 * twist) - 1;
  if (d.twist_match == TwistMatch::paper) return 0.75 * (1 - section.poisson) * excess;
  return 1.5 * (1 - section.poisson) * excess / (3 * excess + 4);
}

void check_isotropy(const Formulation& plate, std::vector<std::string>& warnings) {
  using enum SurfaceCorrection;
  const auto& d = plate.discretization();
  if (d.surface_correction != none && d.surface_correction != volume && d.surface_correction != arbitrary_horizon)
    return;
  constexpr double trusted = 0.01;
  const double off = anisotropy(plate.section(), d);
  if (std::abs(off) <= trusted) return;
  warnings.push_back(
      fmt::format("the lattice is not isotropic at horizon_ratio {:g}: bending stiffness D11 is {:+.2g} % "
                  "off; set volume_correction = \"lattice_fitted\"",
                  d.horizon_ratio, 100 * off));
}

void check_oblique_edges(const Formulation& plate, std::vector<std::string>& warnings) {
  const double usual = plate.error_of_edges();
  if (usual == 0) return;
  warnings.push_back(
      fmt::format("edges oblique to the lattice are stairs for bonds: deflections come out too large, usually by some "
                  "{:.1g} %; set "
                  "formulation = \"galerkin\"",
                  100 * usual));
}

}  // namespace

/// 61 random polygons with cracks and holes, 1/80 of the side: deflections 3.7 % too large in the median, a tenth of
/// them 13 % or more, one 80 %; falling with the spacing. The Galerkin plate on such points: 0.2 %.
double error_of_stairs(const Formulation& plate) {
  const bool oblique = std::ranges::any_of(
      plate.boundary().sides, [](const auto& side) { return !side.circle && !side.support && side.normal_axis() < 0; });
  if (!oblique) return 0;
  const auto [low, high] = geometry::bounding_box(plate.problem().outline);
  return 3 * plate.discretization().spacing / (high - low).minCoeff();
}

std::vector<std::string> estimated_errors(const Formulation& plate) {
  std::vector<std::string> warnings;
  check_thickness(plate, warnings);
  check_stress(plate, warnings);
  return warnings;
}

std::vector<std::string> warnings_about_bonds(const Formulation& plate, bool factors) {
  auto warnings = estimated_errors(plate);
  check_edge_layer(plate, factors, warnings);
  check_isotropy(plate, warnings);
  check_oblique_edges(plate, warnings);
  return warnings;
}

}  // namespace plate
