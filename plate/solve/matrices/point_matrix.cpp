#include "plate/solve/matrices/point_matrix.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "plate/model/space.hpp"

namespace plate {
namespace {

/// The blocks that one unknown point after the other has: which block of the matrix, and whether it is transposed.
struct Placed {
  std::uint32_t row;  // among the points with unknowns
  std::uint32_t transposed;
  std::size_t block;
};

/// Points with unknowns, in the order of those, and of every point its place among them.
struct Places {
  static constexpr auto none = std::uint32_t(-1);
  std::vector<std::uint32_t> point, place;

  Places(const Unknowns& unknowns, std::size_t points) : place(points, none) {
    for (const auto dof : unknowns.dof)
      if (place[dof.point] == none) place[dof.point] = std::uint32_t(point.size()), point.push_back(dof.point);
  }
};

/// Offsets from counts, which stand one to the right.
void accumulate(std::vector<std::size_t>& first) {
  std::partial_sum(first.begin(), first.end(), first.begin());
}

/// Columns in the order of the places, rows ascending; `first`: where they begin.
std::vector<Placed> placed(const PointMatrix& matrix, const Places& places, std::vector<std::size_t>& first) {
  struct Entry {
    std::uint32_t column, transposed;
    std::size_t block;
  };
  const auto for_each = [&](const auto& visit) {
    for (std::uint32_t k = 0; k < matrix.points(); ++k) {
      const auto column = places.place[k];
      if (column == Places::none) continue;
      for (auto b = matrix.first[k]; b < matrix.first[k + 1]; ++b)
        if (const auto row = places.place[matrix.row[b]]; row != Places::none)
          visit(std::max(row, column), Entry{std::min(row, column), row < column, b});
    }
  };
  // sorted by rows, then by columns
  std::vector<std::size_t> by_row(places.point.size() + 1, 0);
  first.assign(places.point.size() + 1, 0);
  for_each([&](std::uint32_t row, const Entry& entry) { ++by_row[row + 1], ++first[entry.column + 1]; });
  accumulate(by_row), accumulate(first);
  std::vector<Entry> entries(by_row.back());
  auto next = by_row;
  for_each([&](std::uint32_t row, const Entry& entry) { entries[next[row]++] = entry; });
  std::vector<Placed> result(entries.size());
  next = first;
  for (std::uint32_t row = 0; row < places.point.size(); ++row)
    for (auto e = by_row[row]; e < by_row[row + 1]; ++e)
      result[next[entries[e].column]++] = {row, entries[e].transposed, entries[e].block};
  return result;
}

}  // namespace

Unknowns unknowns(const Forces& diagonal, const std::vector<int>& order) {
  Unknowns result;
  const auto points = std::size_t(diagonal.cols());
  result.index.assign(unknowns_per_point * points, -1);
  for (std::size_t i = 0; i < (order.empty() ? points : order.size()); ++i) {
    const auto k = order.empty() ? i : std::size_t(order[i]);
    for (const auto dof : dofs_of(k)) {
      if (!(at_dof(diagonal, dof) > 0)) continue;
      result.index[index_in_state(dof, points)] = std::int32_t(result.dof.size());
      result.dof.push_back(dof);
    }
  }
  return result;
}

Eigen::SparseMatrix<double> of_unknowns(const PointMatrix& matrix, const Unknowns& unknowns) {
  const Places places(unknowns, matrix.points());
  std::vector<std::size_t> first;
  const auto blocks = placed(matrix, places, first);
  const auto index_of = [&](const Dof& dof) { return unknowns.index[index_in_state(dof, matrix.points())]; };
  const auto count_of = [&](std::uint32_t place) {
    const auto dofs = dofs_of(places.point[place]);
    return std::size_t(std::ranges::count_if(dofs, [&](const Dof& dof) { return index_of(dof) >= 0; }));
  };
  const auto size = unknowns.size();
  Eigen::SparseMatrix<double> result(size, size);
  std::size_t entries = 0;
  for (std::uint32_t c = 0, u = 0; c < places.point.size(); ++c) {
    std::size_t below = 0;
    for (auto b = first[c] + 1; b < first[c + 1]; ++b) below += count_of(blocks[b].row);
    for (auto own = count_of(c); own > 0; --own) result.outerIndexPtr()[u++] = int(entries), entries += own + below;
  }
  result.outerIndexPtr()[size] = int(entries);
  result.resizeNonZeros(Eigen::Index(entries));
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < places.point.size(); ++c)
    for (std::size_t d = 0; d < unknowns_per_point; ++d) {
      const auto u = index_of(dof(places.point[c], d));
      if (u < 0) continue;
      auto at = result.outerIndexPtr()[u];
      for (auto b = first[c]; b < first[c + 1]; ++b) {
        const auto& K = matrix.block[blocks[b].block];
        for (std::size_t r = 0; r < unknowns_per_point; ++r) {
          const auto v = index_of(dof(places.point[blocks[b].row], r));
          if (v < u) continue;  // none, or above the diagonal
          result.innerIndexPtr()[at] = v;
          const auto row = Eigen::Index(r), column = Eigen::Index(d);
          result.valuePtr()[at++] = blocks[b].transposed ? K(column, row) : K(row, column);
        }
      }
    }
  return result;
}

namespace {

constexpr auto none = std::uint32_t(-1);

/// Shares of leaders in points with a degree of freedom that follows others: u_k = sum of factor times u of the leader.
class Followers {
public:
  struct Share {
    std::uint32_t leader;
    Eigen::Matrix3d factor;
  };

  Followers(const Constraints& constraints, std::size_t points) : place_(points, none) {
    for (const auto& tie : constraints.ties()) {  // ascending by follower
      const auto k = tie.follower.point;
      if (place_[k] == none) begin(k);
      const auto row = Eigen::Index(tie.follower.component);
      shares_[first_[place_[k]]].factor(row, row) = 0;
      share(tie.leader.point).factor(row, Eigen::Index(tie.leader.component)) += tie.factor;
    }
    first_.push_back(shares_.size());
  }
  bool follows(std::uint32_t k) const { return place_[k] != none; }

  /// Calls visit(leader, factor): the point itself with nullptr for the identity where it follows nobody.
  template <typename Visit>
  void for_each(std::uint32_t k, const Visit& visit) const {
    if (!follows(k)) return visit(k, nullptr);
    for (auto s = first_[place_[k]]; s < first_[place_[k] + 1]; ++s) visit(shares_[s].leader, &shares_[s].factor);
  }

private:
  void begin(std::uint32_t k) {
    place_[k] = std::uint32_t(first_.size());
    first_.push_back(shares_.size());
    shares_.push_back({k, Eigen::Matrix3d::Identity()});  // of what does not follow
  }
  /// Share of a leader in the point that was begun last; added as zero where it is new.
  Share& share(std::uint32_t leader) {
    for (auto s = first_.back(); s < shares_.size(); ++s)
      if (shares_[s].leader == leader) return shares_[s];
    return shares_.emplace_back(Share{leader, Eigen::Matrix3d::Zero()});
  }

  std::vector<std::uint32_t> place_;  // of every point among those that follow
  std::vector<std::size_t> first_;
  std::vector<Share> shares_;
};

/// Blocks that are added to a matrix: any number at one place.
class Parts {
public:
  explicit Parts(std::size_t points) : first_(points + 1, 0) {}

  void add(std::uint32_t row, std::uint32_t column, const Eigen::Matrix3d& block) {
    if (row >= column)
      parts_.push_back({column, row, block});
    else
      parts_.push_back({row, column, block.transpose()});
  }

  /// Sums the parts at each place in the order in which they came.
  PointMatrix sum() && {
    for (const auto& part : parts_) ++first_[part.column + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<std::uint32_t> order(parts_.size());
    auto next = first_;
    for (std::uint32_t i = 0; i < parts_.size(); ++i) order[next[parts_[i].column]++] = i;
    PointMatrix result;
    for (std::size_t k = 0; k + 1 < first_.size(); ++k) {
      const auto begin = order.begin() + std::ptrdiff_t(first_[k]), end = order.begin() + std::ptrdiff_t(first_[k + 1]);
      std::stable_sort(begin, end, [&](auto a, auto b) { return parts_[a].row < parts_[b].row; });
      for (auto i = begin; i < end; ++i) {
        const auto& part = parts_[*i];
        if (i != begin && part.row == result.row.back())
          result.block.back() += part.block;
        else
          result.row.push_back(part.row), result.block.push_back(part.block);
      }
      result.first.push_back(result.row.size());
    }
    return result;
  }

private:
  struct Part {
    std::uint32_t column, row;
    Eigen::Matrix3d block;
  };
  std::vector<std::size_t> first_;
  std::vector<Part> parts_;
};

/// T^T K S; nullptr: the identity.
Eigen::Matrix3d between(const Eigen::Matrix3d* T, const Eigen::Matrix3d& K, const Eigen::Matrix3d* S) {
  Eigen::Matrix3d result = K;
  if (T) result = T->transpose() * result;
  if (S) result = result * *S;
  return result;
}

/// Blocks that points which follow others contribute to the points that they follow.
PointMatrix of_leaders(const PointMatrix& matrix, const Followers& followers) {
  Parts parts(matrix.points());
  for (std::uint32_t k = 0; k < matrix.points(); ++k)
    for (auto b = matrix.first[k]; b < matrix.first[k + 1]; ++b) {
      const auto j = matrix.row[b];
      if (!followers.follows(j) && !followers.follows(k)) continue;
      followers.for_each(j, [&](std::uint32_t row, const Eigen::Matrix3d* T) {
        followers.for_each(k, [&](std::uint32_t column, const Eigen::Matrix3d* S) {
          if (j == k && row < column) return;  // the mirror image of what is added
          const Eigen::Matrix3d K = between(T, matrix.block[b], S);
          if (row == column && j != k)
            parts.add(row, column, K + K.transpose());
          else
            parts.add(row, column, K);
        });
      });
    }
  return std::move(parts).sum();
}

}  // namespace

PointMatrix folded(PointMatrix matrix, const Constraints& constraints) {
  if (constraints.ties().empty()) return matrix;
  const Followers followers(constraints, matrix.points());
  const PointMatrix moved = of_leaders(matrix, followers);
  PointMatrix result;
  result.row.reserve(matrix.row.size()), result.block.reserve(matrix.row.size());
  for (std::uint32_t k = 0; k < matrix.points(); ++k) {
    auto m = moved.first[k];
    const auto take = [&](std::uint32_t before) {
      for (; m < moved.first[k + 1] && moved.row[m] < before; ++m)
        result.row.push_back(moved.row[m]), result.block.push_back(moved.block[m]);
    };
    if (!followers.follows(k))
      for (auto b = matrix.first[k]; b < matrix.first[k + 1]; ++b) {
        const auto j = matrix.row[b];
        if (followers.follows(j)) continue;
        take(j);
        result.row.push_back(j), result.block.push_back(matrix.block[b]);
        if (m < moved.first[k + 1] && moved.row[m] == j) result.block.back() += moved.block[m++];
      }
    take(none);
    result.first.push_back(result.row.size());
  }
  return result;
}

void add(const PointMatrix& matrix, double factor, PointMatrix& sum) {
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < matrix.points(); ++k) {
    auto at = sum.first[k];
    for (auto b = matrix.first[k]; b < matrix.first[k + 1]; ++b) {
      while (sum.row[at] != matrix.row[b]) ++at;
      sum.block[at] += factor * matrix.block[b];
    }
  }
}

State product(const PointMatrix& matrix, const State& values) {
  State result = zero_like(values);
  for (std::uint32_t c = 0; c < matrix.points(); ++c)
    for (auto at = matrix.first[c]; at < matrix.first[c + 1]; ++at) {
      const auto r = matrix.row[at];
      result.col(r) += matrix.block[at] * values.col(c);
      if (r != c) result.col(c) += matrix.block[at].transpose() * values.col(r);
    }
  return result;
}

PointMatrix without_rounding(const PointMatrix& matrix) {
  constexpr double rounding = 1e-12;
  PointMatrix result;
  const auto diagonal = [&](std::size_t k) { return matrix.block[matrix.first[k]].diagonal().cwiseAbs(); };
  for (std::size_t k = 0; k < matrix.points(); ++k) {
    for (auto b = matrix.first[k]; b < matrix.first[k + 1]; ++b) {
      const auto& K = matrix.block[b];
      const Eigen::Matrix3d scale = diagonal(matrix.row[b]) * diagonal(k).transpose();
      if (matrix.row[b] == k || (K.cwiseAbs2().array() > rounding * rounding * scale.array()).any())
        result.row.push_back(matrix.row[b]), result.block.push_back(K);
    }
    result.first.push_back(result.row.size());
  }
  return result;
}

PointMatrix with(PointMatrix matrix, const ElasticSupports& elastic_supports) {
  if (elastic_supports.parts().empty()) return matrix;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Eigen::Matrix3d> blocks;  // column, row: on and below the diagonal
  for (const auto& part : elastic_supports.parts())
    part->for_each([&](const Dof& row, const Dof& column, double value) {
      if (row.point < column.point) return;
      const auto [entry, fresh] = blocks.try_emplace({column.point, row.point}, Eigen::Matrix3d::Zero());
      entry->second(row.component, column.component) += value;
    });
  const auto of = [&](std::uint32_t column) { return blocks.lower_bound({column, 0}); };
  auto result = zeros(matrix.points(), [&](Column& column, std::uint32_t k) {
    for (auto i = matrix.first[k]; i < matrix.first[k + 1]; ++i) column.couple(matrix.row[i]);
    for (auto entry = of(k); entry != blocks.end() && entry->first.first == k; ++entry)
      column.couple(entry->first.second);
  });
  for (std::uint32_t k = 0; k < matrix.points(); ++k) {
    auto old = matrix.first[k];
    auto more = of(k);
    for (auto i = result.first[k]; i < result.first[k + 1]; ++i) {
      if (old < matrix.first[k + 1] && matrix.row[old] == result.row[i]) result.block[i] += matrix.block[old++];
      if (more != blocks.end() && more->first == std::pair(k, result.row[i])) result.block[i] += (more++)->second;
    }
  }
  return result;
}

PointMatrix plus(PointMatrix matrix, const Forces& diagonal) {
  for (std::size_t k = 0; k < matrix.points(); ++k)
    matrix.block[matrix.first[k]].diagonal() += diagonal.col(Eigen::Index(k));
  return matrix;
}

}  // namespace plate
