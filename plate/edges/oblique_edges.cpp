#include "plate/edges/oblique_edges.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "plate/model/dense_algebra.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/space.hpp"

namespace plate {

namespace {

using geometry::Point;

int parts(double length) {
  return std::max(1, int(std::lround(length)));
}

void add(const geometry::Circle& hole, std::vector<EdgeNode>& to) {
  const double around = 2 * std::numbers::pi * hole.radius;
  const int count = std::max(3, parts(around));
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / count;
    const Point out(std::cos(angle), std::sin(angle));
    to.push_back({hole.centre + hole.radius * out, -out, around / count});
  }
}

}  // namespace

std::vector<EdgeNode> edge_nodes(const geometry::Outline& outline) {
  std::vector<EdgeNode> result;
  for (const auto& edge : geometry::straight_edges(outline)) {
    const Point along = edge.to - edge.from, unit = along.normalized();
    const int count = parts(along.norm());
    for (int i = 0; i < count; ++i)
      result.push_back({edge.from + (i + 0.5) / count * along, Point(unit.y(), -unit.x()), along.norm() / count});
  }
  for (const auto& hole : outline.holes)
    if (const auto* circle = std::get_if<geometry::Circle>(&hole)) add(*circle, result);
  return result;
}

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;
constexpr double equally_near = 1e-9;  // spacings

Point place(const LatticeBody& b, int k) {
  return b.position(k).head<2>();
}

Eigen::VectorXd monomials_at(const Point& x, int order) {
  Eigen::VectorXd result(order == 1 ? 2 : 5);
  result.head<2>() = x;
  if (order == 2) result.tail<3>() << x.x() * x.x(), x.x() * x.y(), x.y() * x.y();
  return result;
}

/// Place just inside the plate, whose edge rounding may put beyond it.
Point beside(const EdgeNode& node) {
  constexpr double off = 1e-3;  // spacings
  return node.at - off * node.normal;
}

/// Nodes within a distance of an edge node and visible from it.
struct Near {
  std::vector<int> nodes;
  std::vector<Point> away;  // from the edge node
};
Near near_nodes(const LatticeBody& b, const std::vector<EdgeNode>& edges, const Sees& sees, int s, double radius) {
  constexpr double alike = 0.8;  // cosine between normals: values along one edge, or a curved one
  const Point at = edges[std::size_t(s)].at, normal = edges[std::size_t(s)].normal;
  const Eigen::Array2i low = (at.array() - radius).ceil().cast<int>(), high = (at.array() + radius).floor().cast<int>();
  Near result;
  const Point eye = beside(edges[std::size_t(s)]);
  const auto look = [&](int node, const Point& x, const Point& seen) {
    if ((x - at).norm() >= radius || !sees(eye, seen)) return;
    result.nodes.push_back(node), result.away.push_back(x - at);
  };
  for (int y = low.y(); y <= high.y(); ++y)
    for (int x = low.x(); x <= high.x(); ++x)
      if (const int k = b.node({x, y, 0}); k >= 0 && k < b.real) look(k, Point(x, y), Point(x, y));
  for (int q = 0; q < int(edges.size()); ++q)
    if (const auto& other = edges[std::size_t(q)]; q != s && other.normal.dot(normal) > alike)
      look(b.real + q, other.at, beside(other));
  return result;
}

/// Weighted least squares; nothing where the nodes leave a combination of terms all but open.
Eigen::MatrixXd least_squares(const Near& near, double radius, int order) {
  constexpr double open = 1e-4;  // of the largest eigenvalue
  const Eigen::Index count = Eigen::Index(near.nodes.size()), terms = order == 1 ? 2 : 5;
  if (count < terms) return {};
  Eigen::MatrixXd weighted(terms, count), normal = Eigen::MatrixXd::Zero(terms, terms);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Point& x = near.away[std::size_t(i)];
    const Eigen::VectorXd m = monomials_at(x, order);
    weighted.col(i) = std::exp(-4 * x.squaredNorm() / (radius * radius)) * m;
    normal += weighted.col(i) * m.transpose();
  }
  const auto [values, vectors, found] = eigenpairs(normal);
  if (!found || values[0] < open * values[terms - 1]) return {};
  return vectors * values.cwiseInverse().asDiagonal() * vectors.transpose() * weighted;
}

EdgeFit fit(const LatticeBody& b, const ObliqueEdges& edges, const Sees& sees, int s, int order) {
  constexpr double step = 0.25, most = 4;  // spacings
  for (double radius = order == 1 ? 2 : 2.5; radius <= most; radius += step) {
    Near near = near_nodes(b, edges.nodes, sees, s, radius);
    const Eigen::MatrixXd terms = least_squares(near, radius, order);
    if (terms.size() == 0) continue;
    EdgeFit result{std::move(near.nodes), Eigen::MatrixXd(terms.rows(), terms.cols() + 1)};
    result.nodes.push_back(b.real + s);
    result.terms << terms, -terms.rowwise().sum();
    return result;
  }
  const Point at = edges.units.from_lattice(edges.nodes[std::size_t(s)].at);
  throw Refused({{Subject::spacing, 0,
                  fmt::format("an edge has too few points behind it at ({:.4g}, {:.4g}) for surface nodes; refine",
                              at.x(), at.y())}});
}

/// Returns the indices of all places that are as near as the nearest one.
template <typename Places>
std::vector<int> nearest(const Places& distance, int count) {
  std::vector<int> result;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < count; ++i) {
    const double away = distance(i);
    if (away < least - equally_near) result.clear();
    if (away < least + equally_near) result.push_back(i);
    least = std::min(least, away);
  }
  return result;
}

}  // namespace

ObliqueEdges oblique_edges(const LatticeBody& b, std::vector<EdgeNode> nodes, const Sees& sees,
                           const geometry::LatticeUnits& units) {
  ObliqueEdges result{std::move(nodes), {}, {}, {}, units};
  const int count = int(result.nodes.size());
  for (int s = 0; s < count; ++s) {
    result.deflection.push_back(fit(b, result, sees, s, 2));
    result.rotation.push_back(fit(b, result, sees, s, 1));
  }
  for (int k = b.real; k < b.count(); ++k)
    result.nearest.push_back(
        nearest([&](int s) { return (result.nodes[std::size_t(s)].at - place(b, k)).norm(); }, count));
  return result;
}

WeightRows oblique_expansion(const LatticeBody& b, const ObliqueEdges& edges) {
  Triplets entries;
  for (int i = 0; i < unknowns_per_point * b.real; ++i) entries.emplace_back(i, i, 1.0);
  for (int k = b.real; k < b.count(); ++k) {
    const auto& centres = edges.nearest[std::size_t(k - b.real)];
    const double share = 1.0 / double(centres.size());
    for (const int s : centres)
      for (int unknown = 0; unknown < unknowns_per_point; ++unknown) {
        const int order = unknown == 0 ? 2 : 1;
        const EdgeFit& f = (unknown == 0 ? edges.deflection : edges.rotation)[std::size_t(s)];
        const Eigen::VectorXd weights =
            share * f.terms.transpose() * monomials_at(place(b, k) - edges.nodes[std::size_t(s)].at, order);
        entries.emplace_back(index_by_points(k, unknown), index_by_points(b.real + s, unknown), share);
        for (std::size_t i = 0; i < f.nodes.size(); ++i)
          entries.emplace_back(index_by_points(k, unknown), index_by_points(f.nodes[i], unknown),
                               weights[Eigen::Index(i)]);
      }
  }
  WeightRows rows(unknowns_per_point * b.values(), unknowns_per_point * (b.real + Eigen::Index(edges.nodes.size())));
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

WeightRows nearest_values(const LatticeBody& b) {
  Triplets entries;
  std::vector<int> beside;
  for (int k = 0; k < b.real; ++k) {
    entries.emplace_back(k, k, 1.0);
    const auto missing = [&](int x, int y) { return b.node(b.nodes[std::size_t(k)] + LatticeBody::Index(x, y, 0)); };
    if (std::max({missing(1, 0), missing(-1, 0), missing(0, 1), missing(0, -1)}) >= b.real) beside.push_back(k);
  }
  for (int k = b.real; k < b.count(); ++k) {
    const auto near =
        nearest([&](int i) { return (place(b, beside[std::size_t(i)]) - place(b, k)).norm(); }, int(beside.size()));
    for (const int i : near) entries.emplace_back(k, beside[std::size_t(i)], 1.0 / double(near.size()));
  }
  WeightRows rows(b.values(), b.real);
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

}  // namespace plate
