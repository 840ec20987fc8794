#include "geometry/families.hpp"

#include <algorithm>
#include <cmath>
#include <omp.h>
#include <unordered_map>

namespace geometry {
namespace {

/// The cloud's points in lattice units, sorted into square buckets as wide as the horizon.
class Buckets {
public:
  Buckets(const Cloud& cloud, double width) : width_(width), points_(cloud.size()) {
    low_ = Point::Constant(std::numeric_limits<double>::infinity());
    Point high = -low_;
    for (std::size_t k = 0; k < cloud.size(); ++k) {
      points_[k] = cloud.units.to_lattice(cloud.positions[k]);
      low_ = low_.cwiseMin(points_[k]);
      high = high.cwiseMax(points_[k]);
    }
    columns_ = column(high.x()) + 1;
    rows_ = row(high.y()) + 1;
    first_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
    for (const Point& u : points_) ++first_[bucket(u) + 1];
    for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
    members_.resize(points_.size());
    auto next = first_;
    for (std::uint32_t k = 0; k < points_.size(); ++k) members_[next[bucket(points_[k])]++] = k;
  }

  const Point& point(std::uint32_t k) const { return points_[k]; }

  /// The points other than k within `radius` of it, ascending.
  void within(std::uint32_t k, double radius, std::vector<std::uint32_t>& found) const {
    found.clear();
    const Point& u = points_[k];
    const long c = column(u.x()), r = row(u.y());
    for (long y = std::max(0L, r - 1); y <= std::min(rows_ - 1, r + 1); ++y)
      for (long x = std::max(0L, c - 1); x <= std::min(columns_ - 1, c + 1); ++x)
        for (auto m = first_[index(x, y)]; m < first_[index(x, y) + 1]; ++m)
          if (members_[m] != k && (points_[members_[m]] - u).squaredNorm() <= radius * radius)
            found.push_back(members_[m]);
    std::sort(found.begin(), found.end());
  }

private:
  long column(double x) const { return static_cast<long>((x - low_.x()) / width_); }
  long row(double y) const { return static_cast<long>((y - low_.y()) / width_); }
  std::size_t index(long x, long y) const { return static_cast<std::size_t>(y * columns_ + x); }
  std::size_t bucket(const Point& u) const { return index(column(u.x()), row(u.y())); }

  double width_;
  std::vector<Point> points_;
  Point low_{0, 0};
  long columns_ = 0, rows_ = 0;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> members_;
};

/// Runs `collect(k, out)` for every point and joins the lists in the order of the points.
template <typename Collect>
void gather(Families& result, std::size_t points, const Collect& collect) {
  result.first.assign(points + 1, 0);
  std::vector<std::vector<std::uint32_t>> parts(static_cast<std::size_t>(omp_get_max_threads()));
#pragma omp parallel
  {
    auto& part = parts[static_cast<std::size_t>(omp_get_thread_num())];
    std::vector<std::uint32_t> found;
#pragma omp for schedule(static)
    for (std::size_t k = 0; k < points; ++k) {
      const auto before = part.size();
      collect(static_cast<std::uint32_t>(k), found, part);
      result.first[k + 1] = part.size() - before;
    }
  }
  for (std::size_t k = 0; k < points; ++k) result.first[k + 1] += result.first[k];
  result.neighbour.reserve(result.first.back());
  for (auto& part : parts) {
    result.neighbour.insert(result.neighbour.end(), part.begin(), part.end());
    std::vector<std::uint32_t>().swap(part);
  }
}

/// Numbers the distinct bond vectors in order of appearance.
void number_vectors(Families& families, const Buckets& buckets, double spacing) {
  constexpr double grain = 1 << 20;
  std::unordered_map<std::uint64_t, std::uint32_t> ids;
  families.vector_id.resize(families.bonds());
  for (std::uint32_t k = 0; k + 1 < families.first.size(); ++k)
    for (auto b = families.first[k]; b < families.first[k + 1]; ++b) {
      const Point xi = buckets.point(families.neighbour[b]) - buckets.point(k);
      const auto x = static_cast<std::uint32_t>(std::llround(xi.x() * grain));
      const auto y = static_cast<std::uint32_t>(std::llround(xi.y() * grain));
      const auto [entry, fresh] =
          ids.try_emplace((std::uint64_t{x} << 32) | y, static_cast<std::uint32_t>(families.vectors.size()));
      if (fresh) families.vectors.push_back(spacing * xi);
      families.vector_id[b] = entry->second;
    }
}

}  // namespace

Families families(const Cloud& cloud, double horizon, const Pairwise& sees) {
  const double radius = horizon / cloud.units.spacing * (1 + 1e-9);
  const Buckets buckets(cloud, radius);
  Families result;
  gather(result, cloud.size(), [&](std::uint32_t k, auto& found, auto& part) {
    buckets.within(k, radius, found);
    for (const auto j : found)
      if (sees(std::min(k, j), std::max(k, j))) part.push_back(j);
  });
  number_vectors(result, buckets, cloud.units.spacing);
  return result;
}

Families without(const Families& families, const Pairwise& cut) {
  Families result;
  result.vectors = families.vectors;
  std::vector<char> keep(families.bonds());
  gather(result, families.points(), [&](std::uint32_t k, auto&, auto& part) {
    for (auto b = families.first[k]; b < families.first[k + 1]; ++b) {
      const auto j = families.neighbour[b];
      keep[b] = !cut(std::min(k, j), std::max(k, j));
      if (keep[b]) part.push_back(j);
    }
  });
  result.vector_id.reserve(result.bonds());
  for (std::size_t b = 0; b < families.bonds(); ++b)
    if (keep[b]) result.vector_id.push_back(families.vector_id[b]);
  return result;
}

}  // namespace geometry
