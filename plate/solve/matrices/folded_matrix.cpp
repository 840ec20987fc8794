#include <algorithm>
#include <numeric>

#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {
namespace {

constexpr auto none = std::uint32_t(-1);

/// What points with a degree of freedom that follows others are made of: u_k = sum of factor times u of the leader.
class Followers {
public:
  struct Share {
    std::uint32_t leader;
    Eigen::Matrix3d factor;
  };

  Followers(const Constraints& constraints, std::size_t points) : place_(points, none) {
    for (const auto& tie : constraints.ties()) {  // ascending by follower
      const auto k = tie.follower / 3;
      if (place_[k] == none) begin(k);
      const auto row = Eigen::Index(tie.follower % 3);
      shares_[first_[place_[k]]].factor(row, row) = 0;
      share(tie.leader / 3).factor(row, Eigen::Index(tie.leader % 3)) += tie.factor;
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
  /// Of the point that was begun last.
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

/// What the blocks of points that follow others have, for those others.
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

}  // namespace plate
