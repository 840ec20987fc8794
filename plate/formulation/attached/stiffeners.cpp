#include "plate/formulation/attached/stiffeners.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "geometry/cells/locator.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/model/problem.hpp"

namespace plate {
namespace {

using geometry::Point;

/// A place of a beam and what carries it: rotations as shares of those of points, the deflection with what the
/// rotations add to it in a plate without shear, w_i + (x - x_i) . psi_i / 2.
struct Node {
  Point at;
  std::vector<Share> shares;
  std::vector<Point> levers;  // half of the way from each point
};

using Sum = std::map<std::uint32_t, double>;  // factors of degrees of freedom

void add_deflection(const Node& node, double factor, Sum& form) {
  for (std::size_t i = 0; i < node.shares.size(); ++i) {
    const auto [k, share] = node.shares[i];
    form[3 * k] += factor * share;  // psi = (-theta_y, theta_x)
    form[3 * k + 1] += factor * share * node.levers[i].y();
    form[3 * k + 2] -= factor * share * node.levers[i].x();
  }
}

void add_slope(const Node& node, const Point& along, double factor, Sum& form) {
  for (const auto& [k, share] : node.shares) {
    form[3 * k + 1] += factor * share * along.y();
    form[3 * k + 2] -= factor * share * along.x();
  }
}

/// Between two places: E I and G J by the difference of the slopes, and the shear angle by what makes it the cubic line
/// of Hermite, one after the other with the beam's own shear.
void add_element(const Stiffener& beam, const Node& a, const Node& b, AttachmentSum& sum) {
  const Point way = b.at - a.at, along = way.normalized(), across(-along.y(), along.x());
  const double length = way.norm();
  const auto add = [&](double stiffness, const std::function<void(Sum&)>& fill) {
    if (stiffness <= 0) return;
    Sum form;
    fill(form);
    std::vector<FormTerm> terms;
    for (const auto& [dof, factor] : form)
      if (factor != 0) terms.push_back({dof, factor});
    sum.add(stiffness, terms);
  };
  const auto difference = [&](const Point& direction) {
    return [&, direction](Sum& form) { add_slope(b, direction, 1, form), add_slope(a, direction, -1, form); };
  };
  add(beam.bending / length, difference(along));
  add(beam.torsion / length, difference(across));
  const double cubic = 12 * beam.bending / (length * length);
  add(beam.bending > 0 ? (beam.shear ? cubic / (1 + cubic / *beam.shear) : cubic) * length : 0, [&](Sum& form) {
    add_deflection(b, 1 / length, form), add_deflection(a, -1 / length, form);
    add_slope(a, along, -0.5, form), add_slope(b, along, -0.5, form);
  });
}

Node point_node(std::uint32_t k, const geometry::Tessellation& cells) {
  return {cells.positions[k], {{k, 1}}, {Point(0, 0)}};
}

/// visit(a, b) for all elements of a beam.
void for_elements(const Stiffener& beam, const geometry::Tessellation& cells,
                  const std::function<void(const Node&, const Node&)>& visit) {
  for (const auto& border : cells.borders) {
    if (border.edge == geometry::Curves::crack) continue;
    if (std::ranges::find(beam.edges, cells.names[std::size_t(border.edge)]) == beam.edges.end()) continue;
    visit(point_node(border.from, cells), point_node(border.to, cells));
  }
  if (beam.along.empty()) return;
  const geometry::CellLocator locate(cells);
  const auto node_at = [&](const Point& x) {
    Node node{x, {}, {}};
    for (const auto& share : interpolation(locate, cells.units.spacing, x))
      if (std::abs(share.weight) > 1e-9)
        node.shares.push_back({share.point, share.weight}),
            node.levers.push_back((x - cells.positions[share.point]) / 2);
    return node;
  };
  for (std::size_t i = 0; i + 1 < beam.along.size(); ++i) {
    const Point &from = beam.along[i], way = beam.along[i + 1] - from;
    const int count = std::max(1, int(std::lround(way.norm() / cells.units.spacing)));
    std::optional<Node> last;
    for (int n = 0; n <= count; ++n) {
      const Point x = from + way * n / count;
      auto next = cells.sees(x) ? std::optional(node_at(x)) : std::nullopt;
      if (last && next) visit(*last, *next);
      last = std::move(next);
    }
  }
}

}  // namespace

void add_stiffener(const Stiffener& stiffener, const geometry::Tessellation& cells, AttachmentSum& sum) {
  for_elements(stiffener, cells, [&](const Node& a, const Node& b) { add_element(stiffener, a, b, sum); });
}

std::vector<double> stiffener_masses(const Problem& problem, const geometry::Tessellation& cells) {
  std::vector<double> result;
  for (const auto& beam : problem.stiffeners) {
    if (beam.mass <= 0) continue;
    result.resize(cells.positions.size(), 0);
    for_elements(beam, cells, [&](const Node& a, const Node& b) {
      for (const auto* node : {&a, &b})
        for (const auto& [k, share] : node->shares) result[k] += beam.mass * (b.at - a.at).norm() / 2 * share;
    });
  }
  return result;
}

}  // namespace plate
