#include <algorithm>
#include <cmath>

#include "geometry/cells/graded_points.hpp"
#include "geometry/shape/predicates.hpp"

namespace geometry {
namespace {

constexpr int rounds = 5;

/// Which points of a mesh are nodes of its curves: single places among them are on no side of a triangle that is
/// marked.
std::vector<char> nodes_of(const Curves& curves, const TriangleMesh& mesh) {
  const auto before = [](const Point& a, const Point& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); };
  auto nodes = curves.nodes;
  std::ranges::sort(nodes, before);
  std::vector<char> result;
  for (const auto& x : mesh.points()) result.push_back(std::ranges::binary_search(nodes, x, before));
  return result;
}

/// Points that may move, with the triangles about each. `fixed`: points that may not, beside those on curves.
class Stars {
public:
  Stars(const TriangleMesh& mesh, const std::vector<char>& fixed)
      : first_(mesh.points().size() + 1, 0), free_(mesh.points().size(), 1) {
    for (std::size_t k = 0; k < fixed.size(); ++k) free_[k] = !fixed[k];
    for (const auto& triangle : mesh.triangles()) {
      if (!triangle.inside) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        ++first_[triangle.corner[i] + 1];
        if (triangle.mark[i] == TriangleMesh::unmarked) continue;
        free_[triangle.corner[(i + 1) % 3]] = free_[triangle.corner[(i + 2) % 3]] = 0;
      }
    }
    for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
    opposite_.resize(first_.back());
    auto next = first_;
    for (const auto& triangle : mesh.triangles()) {
      if (!triangle.inside) continue;
      const auto& corner = triangle.corner;
      for (std::size_t i = 0; i < 3; ++i) opposite_[next[corner[i]]++] = {corner[(i + 1) % 3], corner[(i + 2) % 3]};
    }
  }

  bool is_free(std::uint32_t k) const { return free_[k] && first_[k] < first_[k + 1]; }

  /// Calls visit(a, b) for the sides opposite to k.
  template <typename Visit>
  void about(std::uint32_t k, const Visit& visit) const {
    for (auto i = first_[k]; i < first_[k + 1]; ++i) visit(opposite_[i].first, opposite_[i].second);
  }

private:
  std::vector<std::size_t> first_;
  std::vector<char> free_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> opposite_;
};

/// Area over the sum of the squared sides: 0 where flat, negative where turned over.
double quality(const Point& a, const Point& b, const Point& c) {
  return cross(b - a, c - a) / ((b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm());
}

}  // namespace

void smooth(TriangleMesh& mesh, const Curves& curves, const Sizing& sizing) {
  const auto fixed = nodes_of(curves, mesh);
  std::vector<double> size;
  for (const auto& x : mesh.points()) size.push_back(sizing(x));
  for (int round = 0; round < rounds; ++round) {
    const Stars stars(mesh, fixed);
    for (std::uint32_t k = 0; k < mesh.points().size(); ++k) {
      if (!stars.is_free(k)) continue;
      const auto& points = mesh.points();
      const Point x = points[k];
      Point sum(0, 0);
      double weights = 0, worst = 1;
      stars.about(k, [&](std::uint32_t a, std::uint32_t b) {
        // centroids by mass, where the density of points goes with 1 / size^2 (Lloyd: by 1 / size^4)
        const double mean = (size[k] + size[a] + size[b]) / 3, square = mean * mean;
        const double weight = cross(points[a] - x, points[b] - x) / (square * square);
        sum += weight * ((points[a] - x) + (points[b] - x)) / 3, weights += weight;
        worst = std::min(worst, quality(x, points[a], points[b]));
      });
      const Point to = x + 1.2 * sum / weights;
      double least = 1;
      stars.about(k, [&](std::uint32_t a, std::uint32_t b) {
        least = std::min(least, side(to, points[a], points[b]) > 0 ? quality(to, points[a], points[b]) : -1);
      });
      if (least < std::min(worst, 0.15) || least <= 0) continue;
      mesh.move(k, to);
      size[k] = sizing(to);
    }
    mesh.exchange_sides();
  }
}

}  // namespace geometry
