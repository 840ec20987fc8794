#pragma once
#include <algorithm>

#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {

/// The rows of one column of blocks, from the diagonal on, each once.
class Column {
public:
  explicit Column(std::size_t points) : seen_by_(points, none) {}

  void begin(std::uint32_t k) {
    k_ = k;
    rows_.clear();
    couple(k);
  }
  void couple(std::uint32_t row) {
    if (row < k_ || seen_by_[row] == k_) return;
    seen_by_[row] = k_;
    rows_.push_back(row);
  }
  const std::vector<std::uint32_t>& sorted() {
    std::sort(rows_.begin(), rows_.end());
    return rows_;
  }

private:
  static constexpr auto none = std::uint32_t(-1);
  std::uint32_t k_ = 0;
  std::vector<std::uint32_t> rows_, seen_by_;
};

/// A matrix of zeros with the rows that couple(column, k) names.
template <typename Couple>
PointMatrix zeros(std::size_t points, const Couple& couple) {
  constexpr std::size_t piece = 512;  // columns that one thread finds at once
  std::vector<std::vector<std::uint32_t>> rows((points + piece - 1) / piece);
  PointMatrix result;
  result.first.assign(points + 1, 0);
#pragma omp parallel
  {
    Column column(points);
#pragma omp for schedule(dynamic)
    for (std::size_t p = 0; p < rows.size(); ++p)
      for (auto k = p * piece; k < std::min(points, (p + 1) * piece); ++k) {
        column.begin(std::uint32_t(k));
        couple(column, std::uint32_t(k));
        const auto& sorted = column.sorted();
        rows[p].insert(rows[p].end(), sorted.begin(), sorted.end());
        result.first[k + 1] = sorted.size();
      }
  }
  for (std::size_t k = 0; k < points; ++k) result.first[k + 1] += result.first[k];
  result.row.reserve(result.first.back());
  for (const auto& some : rows) result.row.insert(result.row.end(), some.begin(), some.end());
  result.block.assign(result.row.size(), Eigen::Matrix3d::Zero());
  return result;
}

}  // namespace plate
