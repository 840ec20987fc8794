#include "plate/formulation/attached/elastically_held.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/cells/tessellation.hpp"
#include "plate/formulation/attached/foundations.hpp"
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

void add_line(const Spring& spring, const std::vector<Point>& positions, std::size_t count, double spacing,
              AttachmentSum& sum) {
  for (const auto& [k, middle, way] : line_pieces(spring.along, positions, count, spacing)) {
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

/// By the point next to it, and the one behind that: linear out to the edge, as soft supports are.
Place on_edge(const Point& x, const Point& n, std::uint32_t k, const geometry::Cloud& cloud,
              const geometry::Families& families) {
  const Point lever = x - cloud.positions[k];
  const Point behind = cloud.positions[k] - cloud.units.spacing * Point(std::round(n.x()), std::round(n.y()));
  for (const auto& bond : families[k]) {
    const auto j = bond.neighbour;
    if (j >= cloud.plate_points || (cloud.positions[j] - behind).norm() > 0.1 * cloud.units.spacing) continue;
    const Point way = cloud.positions[k] - cloud.positions[j];
    const double share = lever.dot(n) / way.dot(n);
    return {{{k, 1 + share}, {j, -share}}, lever - share * way};
  }
  return {{{k, 1}}, lever};
}

void add_edges(const Spring& spring, const Problem& problem, const geometry::Cloud& cloud,
               const geometry::Families& families, AttachmentSum& sum) {
  for (const auto& name : spring.edges)
    for (const auto& border : edge_borders(name, cloud, problem.outline))
      for (const auto& [middle, normal] : border.pieces) {
        const Point n = normal.normalized();
        const auto at = on_edge(middle, n, nearest(border.near, cloud, middle), cloud, families);
        add_piece(spring, normal.norm(), at, n, sum);
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

/// `found(foundation, sum)`, `hold(spring, sum)`: what they add.
template <typename Found, typename Hold>
AttachedStiffness all(const Problem& problem, std::size_t points, const Found& found, const Hold& hold) {
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
  return AttachedStiffness(std::move(parts));
}

}  // namespace

AttachedStiffness attached_stiffness(const Problem& problem, const geometry::Cloud& cloud,
                                     const geometry::Families& families) {
  return all(
      problem, cloud.size(), [&](const Foundation& one, AttachmentSum& sum) { add_foundation(one, cloud, sum); },
      [&](const Spring& one, AttachmentSum& sum) {
        add_edges(one, problem, cloud, families, sum);
        if (!one.along.empty()) add_line(one, cloud.positions, cloud.plate_points, cloud.units.spacing, sum);
        if (one.position) add_point(one, cloud.positions, cloud.plate_points, sum);
      });
}

AttachedStiffness attached_stiffness(const Problem& problem, const geometry::Tessellation& cells) {
  const auto points = cells.positions.size();
  return all(
      problem, points, [&](const Foundation& one, AttachmentSum& sum) { add_foundation(one, cells, sum); },
      [&](const Spring& one, AttachmentSum& sum) {
        add_edges(one, cells, sum);
        if (!one.along.empty()) add_line(one, cells.positions, points, cells.units.spacing, sum);
        if (one.position) add_point(one, cells.positions, points, sum);
      });
}

}  // namespace plate
