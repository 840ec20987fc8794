#include "plate/formulation/attached/elastically_held.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/cells/tessellation.hpp"
#include "plate/formulation/attached/foundations.hpp"
#include "plate/formulation/attached/stiffeners.hpp"
#include "plate/model/loading/edge_pieces.hpp"
#include "plate/model/loading/spread.hpp"
#include "plate/model/problem.hpp"

namespace plate {
namespace {

using geometry::Point;
using Form = std::vector<FormTerm>;

/// A place of an edge or a line: its value as shares of the values of points, and what the rotations of the first of
/// them add to the deflection there.
struct Place {
  std::vector<std::pair<std::uint32_t, double>> shares;
  Point lever{0, 0};
};

Form deflection(const Place& at) {
  Form form;
  for (const auto& [k, share] : at.shares) form.push_back({3 * k, share});
  const auto first = at.shares.front().first;
  form.push_back({3 * first + 1, at.lever.y()});
  form.push_back({3 * first + 2, -at.lever.x()});
  return form;
}

/// Of psi = (-theta_y, theta_x) along a direction.
Form slope(const Place& at, const Point& n) {
  Form form;
  for (const auto& [k, share] : at.shares) {
    form.push_back({3 * k + 1, share * n.y()});
    form.push_back({3 * k + 2, -share * n.x()});
  }
  return form;
}

/// A spring over a length of an edge or line with the unit normal n.
void add_piece(const Spring& spring, double length, const Place& at, const Point& n, AttachmentSum& sum) {
  if (spring.deflection > 0) sum.add(length * spring.deflection, deflection(at));
  if (spring.rotation_normal > 0) sum.add(length * spring.rotation_normal, slope(at, n));
  if (spring.rotation_tangential > 0) sum.add(length * spring.rotation_tangential, slope(at, {-n.y(), n.x()}));
}

void add_line(const Spring& spring, const std::vector<LinePiece>& pieces, const std::vector<Point>& positions,
              AttachmentSum& sum) {
  for (const auto& [k, middle, way] : pieces) {
    const Point n = Point(way.y(), -way.x()) / way.norm();
    add_piece(spring, way.norm(), {{{std::uint32_t(k), 1}}, middle - positions[k]}, n, sum);
  }
}

void add_point(const Spring& spring, const std::vector<Point>& positions, std::size_t count, AttachmentSum& sum) {
  const auto away = [&](const Point& x) { return (x - *spring.position).squaredNorm(); };
  const auto end = positions.begin() + std::ptrdiff_t(count);
  const auto k = std::uint32_t(std::ranges::min_element(positions.begin(), end, {}, away) - positions.begin());
  const Place at{{{k, 1}}, *spring.position - positions[k]};
  if (spring.deflection > 0) sum.add(spring.deflection, deflection(at));
  for (const Point& n : {Point(1, 0), Point(0, 1)})
    if (spring.rotation > 0) sum.add(spring.rotation, slope(at, n));
}

/// What the points beside an edge have of it: length, and where its middle is.
struct Stretch {
  double length = 0;
  Point moment{0, 0}, normal{0, 0};  // integrals of the place and of the outward normal
};

/// Loads on an edge: forces beside any others, moments and nothing else.
struct EdgeLoads {
  bool shear = false, moments_alone = false;
};

EdgeLoads loads_on(const std::string& edge, const Problem& problem) {
  EdgeLoads result{false, !problem.loads.empty()};
  for (const auto& load : problem.loads) {
    const bool here = std::ranges::find(load.edges, edge) != load.edges.end();
    result.shear |= here && load.kind == Load::Kind::edge_shear;
    result.moments_alone &= here && load.kind == Load::Kind::edge_moment;
  }
  return result;
}

/// A spring and the strip of the plate between the edge and the point next to it, `away` wide, one after the other. A
/// force on the same edge acts at that point too and must not pass through the strip: then the spring alone; also under
/// moments, but for other loads the strip turns.
Spring behind(Spring spring, double away, const Section& section, const EdgeLoads& loads) {
  const auto soften = [&](double& stiffness, double of_plate) { stiffness /= 1 + stiffness * away / of_plate; };
  const double D = section.bending_stiffness();
  if (!loads.shear) soften(spring.deflection, section.shear_stiffness());
  if (loads.moments_alone) return spring;
  soften(spring.rotation_normal, D);
  soften(spring.rotation_tangential, D * (1 - section.poisson) / 2);
  return spring;
}

void add_edges(const Spring& spring, const Problem& problem, const geometry::Cloud& cloud, AttachmentSum& sum) {
  for (const auto& name : spring.edges) {
    const auto loads = loads_on(name, problem);
    for (const auto& border : edge_borders(name, cloud, problem.outline)) {
      std::map<std::uint32_t, Stretch> by_point;
      for (const auto& [middle, normal] : border.pieces) {
        auto& stretch = by_point[nearest(border.near, cloud, middle)];
        stretch.length += normal.norm(), stretch.moment += normal.norm() * middle, stretch.normal += normal;
      }
      for (const auto& [k, stretch] : by_point) {
        const Point n = stretch.normal.normalized(), lever = stretch.moment / stretch.length - cloud.positions[k];
        const double away = std::max(0.0, lever.dot(n));
        add_piece(behind(spring, away, problem.section, loads), stretch.length, {{{k, 1}}, lever}, n, sum);
      }
    }
  }
}

/// Between the ends of a piece all is linear; two places of Gauss are exact for its square.
void add_edges(const Spring& spring, const geometry::Tessellation& cells, AttachmentSum& sum) {
  const double gauss = (1 - 1 / std::sqrt(3.0)) / 2;
  for (const auto& border : cells.borders) {
    if (border.edge == geometry::Curves::crack) continue;
    if (std::ranges::find(spring.edges, cells.names[std::size_t(border.edge)]) == spring.edges.end()) continue;
    const Point way = cells.positions[border.to] - cells.positions[border.from];
    for (const double at : {gauss, 1 - gauss})
      add_piece(spring, way.norm() / 2, {{{border.from, 1 - at}, {border.to, at}}},
                Point(way.y(), -way.x()) / way.norm(), sum);
  }
}

/// `found(foundation, sum)`, `hold(spring, sum)`, `stiffen(stiffener, sum)`: what they add.
template <typename Found, typename Hold, typename Stiffen>
AttachedStiffness all(const Problem& problem, std::size_t points, const Found& found, const Hold& hold,
                      const Stiffen& stiffen) {
  std::vector<Attachment> parts;
  for (std::size_t i = 0; i < problem.foundations.size(); ++i) {
    AttachmentSum sum(points);
    found(problem.foundations[i], sum);
    parts.push_back(std::move(sum).taken(fmt::format("foundation{}", i), std::nullopt));
  }
  for (std::size_t i = 0; i < problem.springs.size(); ++i) {
    AttachmentSum sum(points);
    hold(problem.springs[i], sum);
    parts.push_back(std::move(sum).taken(fmt::format("spring{}", i), problem.springs[i].position));
  }
  for (std::size_t i = 0; i < problem.stiffeners.size(); ++i) {
    AttachmentSum sum(points);
    stiffen(problem.stiffeners[i], sum);
    parts.push_back(std::move(sum).taken(fmt::format("stiffener{}", i), std::nullopt, false));
  }
  return AttachedStiffness(std::move(parts));
}

}  // namespace

AttachedStiffness attached_stiffness(const Problem& problem, const geometry::Cloud& cloud) {
  return all(
      problem, cloud.size(), [&](const Foundation& one, AttachmentSum& sum) { add_foundation(one, cloud, sum); },
      [&](const Spring& one, AttachmentSum& sum) {
        add_edges(one, problem, cloud, sum);
        if (!one.along.empty())
          add_line(one, line_pieces(one.along, cloud, crack_paths(problem)), cloud.positions, sum);
        if (one.position && cloud.seeded(*one.position)) add_point(one, cloud.positions, cloud.plate_points, sum);
      },
      [](const Stiffener&, AttachmentSum&) {});  // refused before
}

AttachedStiffness attached_stiffness(const Problem& problem, const geometry::Tessellation& cells) {
  const auto points = cells.positions.size();
  return all(
      problem, points, [&](const Foundation& one, AttachmentSum& sum) { add_foundation(one, cells, sum); },
      [&](const Spring& one, AttachmentSum& sum) {
        add_edges(one, cells, sum);
        if (!one.along.empty()) add_line(one, line_pieces(one.along, cells), cells.positions, sum);
        if (one.position && cells.sees(*one.position)) add_point(one, cells.positions, points, sum);
      },
      [&](const Stiffener& one, AttachmentSum& sum) { add_stiffener(one, cells, sum); });
}

}  // namespace plate
