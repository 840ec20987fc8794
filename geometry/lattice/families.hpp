#pragma once
#include <cstdint>
#include <functional>

#include "geometry/lattice/cloud.hpp"

namespace geometry {

/// A directed bond of a point: the other point, and which of the bond vectors leads to it.
struct Bond {
  std::uint32_t neighbour, vector_id;
};

/// Directed bonds of every point, by ascending neighbour. Points whose bonds look the same, to the numbering too,
/// share one pattern of them: a lattice has one for nearly all of its points, any cloud one for each at most. Bonds
/// of the same vector share one entry of `vectors` (28 on a square lattice with horizon 3.015 spacings).
class Families {
public:
  struct Step {
    std::int32_t step;  // neighbour - point
    std::uint32_t vector_id;
  };

  /// The bonds of one point.
  class Family {
  public:
    class Iterator {
    public:
      Iterator(std::uint32_t point, const Step* at) : point_(point), at_(at) {}
      Bond operator*() const { return {point_ + static_cast<std::uint32_t>(at_->step), at_->vector_id}; }
      Iterator& operator++() { return ++at_, *this; }
      bool operator!=(const Iterator& other) const { return at_ != other.at_; }

    private:
      std::uint32_t point_;
      const Step* at_;
    };

    Family(std::uint32_t point, const Step* begin, const Step* end) : point_(point), begin_(begin), end_(end) {}
    Iterator begin() const { return {point_, begin_}; }
    Iterator end() const { return {point_, end_}; }
    std::size_t size() const { return static_cast<std::size_t>(end_ - begin_); }
    bool empty() const { return begin_ == end_; }
    Bond operator[](std::size_t i) const { return *Iterator(point_, begin_ + i); }
    /// Index of the bond that leads to point j; size() where none does.
    std::size_t find(std::uint32_t j) const;

  private:
    std::uint32_t point_;
    const Step *begin_, *end_;
  };

  Families() = default;
  /// `pattern` [points]: which of the patterns; the steps of pattern p are first[p] ... first[p + 1] - 1.
  Families(std::vector<Point> vectors, std::vector<std::uint32_t> pattern, std::vector<std::size_t> first,
           std::vector<Step> steps);

  Family operator[](std::size_t k) const {
    const Step* const all = steps_.data();
    return {static_cast<std::uint32_t>(k), all + first_[pattern_[k]], all + first_[pattern_[k] + 1]};
  }
  /// Gives point k, or the next new point, a family of its own: `steps` ascending.
  void set(std::size_t k, const std::vector<Step>& steps);

  std::size_t points() const { return pattern_.size(); }
  std::size_t bonds() const { return bonds_; }
  std::uint32_t pattern(std::size_t k) const { return pattern_[k]; }
  const std::vector<Point>& vectors() const { return vectors_; }  // x_j - x_k [length]
  std::size_t bytes() const;

private:
  std::vector<Point> vectors_;
  std::vector<std::uint32_t> pattern_;
  std::vector<std::size_t> first_{0};
  std::vector<Step> steps_;
  std::size_t bonds_ = 0;
};

/// A question about the points k < j of a cloud; asked from several threads at once.
using Pairwise = std::function<bool(std::uint32_t k, std::uint32_t j)>;

/// Adds the neighbours of point k to an empty list, ascending; asked from several threads at once.
using Neighbours = std::function<void(std::uint32_t k, std::vector<std::uint32_t>& found)>;

/// The families that `neighbours` lists. Bonds between lattice points, the `local` [length] coordinates of which are
/// multiples of `spacing`, are of the same vector where they look the same; any other has a vector of its own, exact.
Families families(double spacing, const std::vector<Point>& local, const Neighbours& neighbours);

/// Families of all pairs within the horizon that see each other.
Families families(const Cloud& cloud, double horizon, const Pairwise& sees);

/// The families without the bonds that are cut.
Families without(const Families& families, const Pairwise& cut);

/// Families in the form that a vector unit likes: neighbouring points whose families look alike (same kind, neighbours
/// of the same kinds at the same distances in the numbering) share one pattern, and follow each other in runs. On a
/// lattice numbered by rows, a run is a piece of a row; any cloud has runs, if only of one point.
struct FamilyRuns {
  struct Run {
    std::uint32_t first_point, length, pattern;
  };

  std::vector<Run> runs;               // ascending; every point is in one
  std::vector<std::uint32_t> example;  // a point of every pattern
};

/// Runs of at most `longest` points, so that they can be shared out among threads. `kind`: a number for every point,
/// the same only for points with equal bond vectors. `block`: a number for every point, where no run is to hold points
/// with different ones.
FamilyRuns family_runs(const Families& families, const std::vector<std::uint32_t>& kind, std::uint32_t longest,
                       const std::vector<std::uint32_t>& block = {});

}  // namespace geometry
