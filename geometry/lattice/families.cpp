#include "geometry/lattice/families.hpp"

#include <omp.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "geometry/lattice/grouped.hpp"

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
    members_ = {static_cast<std::size_t>(columns_ * rows_), [&](const auto& visit) {
                  for (std::uint32_t k = 0; k < points_.size(); ++k) visit(bucket(points_[k]), k);
                }};
  }

  const std::vector<Point>& points() const { return points_; }

  /// The points other than k within `radius` of it, ascending.
  void within(std::uint32_t k, double radius, std::vector<std::uint32_t>& found) const {
    found.clear();
    const Point& u = points_[k];
    const long c = column(u.x()), r = row(u.y());
    for (long y = std::max(0L, r - 1); y <= std::min(rows_ - 1, r + 1); ++y)
      for (long x = std::max(0L, c - 1); x <= std::min(columns_ - 1, c + 1); ++x)
        for (const auto j : members_[index(x, y)])
          if (j != k && (points_[j] - u).squaredNorm() <= radius * radius) found.push_back(j);
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
  Grouped<std::uint32_t> members_;  // of buckets
};

/// A bond before its vector has a number.
struct Found {
  std::int64_t step;
  std::uint64_t vector;
  auto operator<=>(const Found&) const = default;
};
using Pattern = std::vector<Found>;

/// Numbers patterns in order of appearance.
class Patterns {
public:
  std::uint32_t number(const Pattern& pattern) {
    if (!order_.empty() && *order_[last_] == pattern) return last_;
    const auto [entry, fresh] = known_.try_emplace(pattern, static_cast<std::uint32_t>(order_.size()));
    if (fresh) order_.push_back(&entry->first);
    return last_ = entry->second;
  }
  const std::vector<const Pattern*>& in_order() const { return order_; }

private:
  std::map<Pattern, std::uint32_t> known_;
  std::vector<const Pattern*> order_;
  std::uint32_t last_ = 0;
};

/// The patterns that `collect(k, scratch, pattern)` finds, and which of them every point has; the same for any number
/// of threads, each of which sees points that follow each other.
template <typename Collect>
std::pair<Patterns, std::vector<std::uint32_t>> patterns(std::size_t points, const Collect& collect) {
  std::vector<std::uint32_t> pattern_of(points);
  std::vector<Patterns> parts(static_cast<std::size_t>(omp_get_max_threads()));
  std::vector<std::uint32_t> part_of(points);
#pragma omp parallel
  {
    const auto thread = static_cast<std::uint32_t>(omp_get_thread_num());
    std::vector<std::uint32_t> scratch;
    Pattern pattern;
#pragma omp for schedule(static)
    for (std::size_t k = 0; k < points; ++k) {
      pattern.clear();
      collect(static_cast<std::uint32_t>(k), scratch, pattern);
      pattern_of[k] = parts[thread].number(pattern);
      part_of[k] = thread;
    }
  }
  Patterns all;
  std::vector<std::vector<std::uint32_t>> numbers(parts.size());
  for (std::size_t t = 0; t < parts.size(); ++t)
    for (const Pattern* pattern : parts[t].in_order()) numbers[t].push_back(all.number(*pattern));
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < points; ++k) pattern_of[k] = numbers[part_of[k]][pattern_of[k]];
  return {std::move(all), std::move(pattern_of)};
}

/// `vector_id(vector)`: number of a bond vector, asked for in order of appearance.
template <typename VectorId>
Families joined(const Patterns& patterns, std::vector<std::uint32_t> pattern_of, std::vector<Point>& vectors,
                const VectorId& vector_id) {
  std::vector<std::size_t> first{0};
  std::vector<Families::Step> steps;
  for (const Pattern* pattern : patterns.in_order()) {
    for (const Found& bond : *pattern) steps.push_back({static_cast<std::int32_t>(bond.step), vector_id(bond.vector)});
    first.push_back(steps.size());
  }
  return {std::move(vectors), std::move(pattern_of), std::move(first), std::move(steps)};
}

}  // namespace

Families::Families(std::vector<Point> vectors, std::vector<std::uint32_t> pattern, std::vector<std::size_t> first,
                   std::vector<Step> steps)
    : vectors_(std::move(vectors)), pattern_(std::move(pattern)), first_(std::move(first)), steps_(std::move(steps)) {
  for (const auto p : pattern_) bonds_ += first_[p + 1] - first_[p];
}

void Families::set(std::size_t k, const std::vector<Step>& steps) {
  if (k < pattern_.size()) bonds_ -= (*this)[k].size();
  pattern_.resize(std::max(k + 1, pattern_.size()));
  pattern_[k] = std::uint32_t(first_.size() - 1);
  steps_.insert(steps_.end(), steps.begin(), steps.end());
  first_.push_back(steps_.size());
  bonds_ += steps.size();
}

std::size_t Families::Family::find(std::uint32_t j) const {
  const auto step = static_cast<std::int32_t>(j - point_);
  const Step* const at = std::lower_bound(begin_, end_, step, [](const Step& a, std::int32_t b) { return a.step < b; });
  return at < end_ && at->step == step ? static_cast<std::size_t>(at - begin_) : size();
}

std::size_t Families::bytes() const {
  return pattern_.size() * sizeof(std::uint32_t) + steps_.size() * sizeof(Step) + first_.size() * sizeof(std::size_t) +
         vectors_.size() * sizeof(Point);
}

namespace {

/// Families of the bonds that `neighbours` lists. Bonds with the same code(k, j) have the same vector, vector_of(code).
template <typename Code, typename VectorOf>
Families coded_families(std::size_t points, const Neighbours& neighbours, const Code& code, const VectorOf& vector_of) {
  const auto [found, pattern_of] = patterns(points, [&](std::uint32_t k, auto& near, Pattern& pattern) {
    near.clear();
    neighbours(k, near);
    for (const auto j : near) pattern.push_back({std::int64_t(j) - std::int64_t(k), code(k, j)});
  });
  std::unordered_map<std::uint64_t, std::uint32_t> ids;
  std::vector<Point> vectors;
  return joined(found, pattern_of, vectors, [&](std::uint64_t vector) {
    const auto [entry, fresh] = ids.try_emplace(vector, static_cast<std::uint32_t>(vectors.size()));
    if (fresh) vectors.push_back(vector_of(vector));
    return entry->second;
  });
}

}  // namespace

Families families(double spacing, const std::vector<Point>& local, const Neighbours& neighbours) {
  constexpr std::uint64_t own = std::uint64_t{1} << 63, middle = 1 << 30;
  std::vector<char> regular(local.size());
  const auto on_line = [spacing](double x) { return spacing * std::round(x / spacing) == x; };
  for (std::size_t k = 0; k < local.size(); ++k) regular[k] = on_line(local[k].x()) && on_line(local[k].y());
  const auto code = [&](std::uint32_t k, std::uint32_t j) {
    if (!regular[k] || !regular[j])
      return own | std::uint64_t(k) << 31 | (std::uint64_t(std::int64_t(j) - std::int64_t(k)) + middle);
    const Point u = (local[j] - local[k]) / spacing;
    return std::uint64_t(std::llround(u.x()) + std::int64_t(middle)) << 31 |
           std::uint64_t(std::llround(u.y()) + std::int64_t(middle));
  };
  const auto vector_of = [&](std::uint64_t vector) -> Point {
    const auto low = std::int64_t(vector & (2 * middle - 1)) - std::int64_t(middle);
    const auto high = std::int64_t((vector & ~own) >> 31);
    if (vector & own) return local[std::size_t(high + low)] - local[std::size_t(high)];
    return spacing * Point(double(high - std::int64_t(middle)), double(low));
  };
  return coded_families(local.size(), neighbours, code, vector_of);
}

Families families(const Cloud& cloud, double horizon, const Pairwise& sees) {
  constexpr double grain = 1 << 20;  // bond vectors are numbered by multiples of this part of a spacing
  const double radius = horizon / cloud.units.spacing * (1 + 1e-9);
  const Buckets buckets(cloud, radius);
  const auto neighbours = [&](std::uint32_t k, std::vector<std::uint32_t>& near) {
    buckets.within(k, radius, near);
    std::erase_if(near, [&](std::uint32_t j) { return !sees(std::min(k, j), std::max(k, j)); });
  };
  const auto code = [&](std::uint32_t k, std::uint32_t j) {
    const Point xi = buckets.points()[j] - buckets.points()[k];
    const auto x = static_cast<std::uint32_t>(std::llround(xi.x() * grain));
    const auto y = static_cast<std::uint32_t>(std::llround(xi.y() * grain));
    return (std::uint64_t{x} << 32) | y;
  };
  const auto vector_of = [&](std::uint64_t vector) -> Point {
    const Point xi(static_cast<std::int32_t>(vector >> 32), static_cast<std::int32_t>(vector & 0xffffffff));
    return cloud.units.spacing / grain * xi;
  };
  return coded_families(cloud.size(), neighbours, code, vector_of);
}

Families without(const Families& families, const Pairwise& cut) {
  const auto [found, pattern_of] = patterns(families.points(), [&](std::uint32_t k, auto&, Pattern& pattern) {
    for (const auto& bond : families[k])
      if (!cut(std::min(k, bond.neighbour), std::max(k, bond.neighbour)))
        pattern.push_back({std::int64_t(bond.neighbour) - std::int64_t(k), bond.vector_id});
  });
  auto vectors = families.vectors();
  return joined(found, pattern_of, vectors, [](std::uint64_t id) { return static_cast<std::uint32_t>(id); });
}

namespace {

/// Kind of point k and pattern of its family, then the kind of every neighbour.
std::vector<std::uint32_t> look_of(const Families& families, const std::vector<std::uint32_t>& kind, std::uint32_t k) {
  std::vector<std::uint32_t> look{kind[k], families.pattern(k)};
  for (const auto& bond : families[k]) look.push_back(kind[bond.neighbour]);
  return look;
}

/// True where point k has the bonds of the point before it.
bool alike(const Families& families, const std::vector<std::uint32_t>& kind, std::uint32_t k) {
  if (kind[k] != kind[k - 1] || families.pattern(k) != families.pattern(k - 1)) return false;
  for (const auto& bond : families[k])
    if (kind[bond.neighbour] != kind[bond.neighbour - 1]) return false;
  return true;
}

}  // namespace

FamilyRuns family_runs(const Families& families, const std::vector<std::uint32_t>& kind, std::uint32_t longest,
                       const std::vector<std::uint32_t>& block) {
  FamilyRuns result;
  std::map<std::vector<std::uint32_t>, std::uint32_t> known;
  for (std::uint32_t k = 0; k < families.points(); ++k) {
    const bool same = k > 0 && alike(families, kind, k);
    const bool together = same && (block.empty() || block[k] == block[k - 1]);
    if (together && result.runs.back().length < longest) {
      ++result.runs.back().length;
      continue;
    }
    if (same) {
      result.runs.push_back({k, 1, result.runs.back().pattern});
      continue;
    }
    const auto [entry, fresh] = known.try_emplace(look_of(families, kind, k), static_cast<std::uint32_t>(known.size()));
    if (fresh) result.example.push_back(k);
    result.runs.push_back({k, 1, entry->second});
  }
  return result;
}

}  // namespace geometry
