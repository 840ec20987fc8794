// Points, triangles, families and nodal normals of a rectangle, of its image under a map and of a part of its cells.
#include <algorithm>
#include <random>
#include <stdexcept>

#include "tests/verification/galerkin/systems.hpp"

namespace galerkin_systems {
namespace {

Eigen::Matrix2Xd lattice_points(const Lattice& l) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-l.perturbation, l.perturbation);
  const double dx = l.width / l.columns, dy = l.height / l.rows;
  Eigen::Matrix2Xd points(2, (l.columns + 1) * (l.rows + 1));
  int k = 0;
  for (int r = 0; r <= l.rows; ++r)
    for (int c = 0; c <= l.columns; ++c) {
      const double x = uniform(random), y = uniform(random);
      const bool side = c == 0 || c == l.columns, end = r == 0 || r == l.rows;
      points.col(k++) = Eigen::Vector2d((c + (side ? 0 : x)) * dx, (r + (end ? 0 : y)) * dy);
    }
  return points;
}

std::vector<Nodes> lattice_families(const Lattice& l) {
  std::vector<Nodes> families;
  for (int r = 0; r <= l.rows; ++r)
    for (int c = 0; c <= l.columns; ++c) {
      Nodes nodes{r * (l.columns + 1) + c};
      const int reach = l.reach == Reach::cells ? 1 : 2;
      for (int dr = -reach; dr <= reach; ++dr)
        for (int dc = -reach; dc <= reach; ++dc) {
          const bool inside = r + dr >= 0 && r + dr <= l.rows && c + dc >= 0 && c + dc <= l.columns;
          const bool near = l.reach != Reach::circle || dr * dr + dc * dc < 2.51 * 2.51;
          if (inside && near && (dr != 0 || dc != 0)) nodes.push_back((r + dr) * (l.columns + 1) + c + dc);
        }
      families.push_back(nodes);
    }
  return families;
}

void lay_cells(Body& b, const Lattice& l) {
  for (int r = 0; r < l.rows; ++r)
    for (int c = 0; c < l.columns; ++c) {
      const int k = r * (l.columns + 1) + c;
      b.cells.push_back({k, k + 1, k + l.columns + 2, k + l.columns + 1});
    }
}

/// Both diagonals of every cell: four triangles, each counted half.
void cut_cells(Body& b) {
  for (const auto& q : b.cells)
    for (std::size_t i = 0; i < 4; ++i) b.triangles.push_back({{q[i], q[(i + 1) % 4], q[(i + 2) % 4]}, 0.5});
}

void walk_outline(Body& b, const Lattice& l) {
  const int right = l.columns, top = l.rows, row = l.columns + 1;
  for (int c = 0; c < right; ++c) b.outline.push_back({c, c + 1});
  for (int r = 0; r < top; ++r) b.outline.push_back({r * row + right, (r + 1) * row + right});
  for (int c = right; c > 0; --c) b.outline.push_back({top * row + c, top * row + c - 1});
  for (int r = top; r > 0; --r) b.outline.push_back({r * row, (r - 1) * row});
}

/// Areas and normals of points whose triangles and outline are known.
void measure(Body& b) {
  b.areas = Eigen::VectorXd::Zero(b.points.cols());
  b.normals = Eigen::Matrix2Xd::Zero(2, b.points.cols());
  for (const Triangle& t : b.triangles) {
    Eigen::Matrix2d sides;
    sides << b.points.col(t.corners[1]) - b.points.col(t.corners[0]),
        b.points.col(t.corners[2]) - b.points.col(t.corners[0]);
    if (sides.determinant() <= 0) throw std::runtime_error("a triangle of the perturbed lattice is turned over");
    for (const int k : t.corners) b.areas[k] += t.share * sides.determinant() / 6;
  }
  for (const auto& [from, to] : b.outline) {
    const Eigen::Vector2d edge = b.points.col(to) - b.points.col(from), normal(edge.y(), -edge.x());
    b.normals.col(from) += normal / 2;
    b.normals.col(to) += normal / 2;
  }
}

/// The edges of cells that no second cell walks the other way.
std::vector<std::array<int, 2>> outline(const std::vector<std::array<int, 4>>& cells) {
  std::vector<std::array<int, 2>> edges, once;
  for (const auto& q : cells)
    for (std::size_t i = 0; i < 4; ++i) edges.push_back({q[i], q[(i + 1) % 4]});
  for (const auto& [from, to] : edges)
    if (std::find(edges.begin(), edges.end(), std::array{to, from}) == edges.end()) once.push_back({from, to});
  return once;
}

}  // namespace

Body body(const Lattice& l, const Map& map) {
  Body b{lattice_points(l), {}, {}, {}, {}, lattice_families(l), {}, l.width, l.height};
  if (map)
    for (Eigen::Index k = 0; k < b.points.cols(); ++k) b.points.col(k) = map(b.points.col(k));
  lay_cells(b, l);
  cut_cells(b);
  walk_outline(b, l);
  measure(b);
  return b;
}

Part part(const Body& whole, const std::function<bool(const Eigen::Vector2d&)>& holds) {
  Part p{{}, {}};
  std::vector<int> name(std::size_t(whole.points.cols()), -1);
  std::vector<bool> inside(name.size(), false);
  for (const auto& q : whole.cells) {
    const Eigen::Vector2d middle = whole.points(Eigen::all, q).rowwise().mean();
    if (!holds(middle)) continue;
    p.body.cells.push_back(q);
    for (const int k : q) inside[std::size_t(k)] = true;
  }
  for (std::size_t k = 0; k < inside.size(); ++k)
    if (inside[k]) {
      name[k] = int(p.names.size());
      p.names.push_back(int(k));
    }
  p.body.points = whole.points(Eigen::all, p.names);
  for (auto& q : p.body.cells)
    for (int& k : q) k = name[std::size_t(k)];
  for (const int k : p.names) {
    Nodes family;
    for (const int i : whole.families[std::size_t(k)])
      if (inside[std::size_t(i)]) family.push_back(name[std::size_t(i)]);
    p.body.families.push_back(family);
  }
  p.body.width = whole.width, p.body.height = whole.height;
  p.body.outline = outline(p.body.cells);
  cut_cells(p.body);
  measure(p.body);
  return p;
}

System renamed(System system, const Nodes& names) {
  for (Family& f : system)
    for (int& node : f.nodes) node = names[std::size_t(node)];
  return system;
}

}  // namespace galerkin_systems
