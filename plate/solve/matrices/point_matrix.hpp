#pragma once
#include <Eigen/SparseCore>
#include <algorithm>
#include <vector>

#include "plate/formulation/constraints.hpp"
#include "plate/formulation/elastic_supports.hpp"

namespace plate {

/// A symmetric matrix in blocks of 3 x 3, one for every pair of points that it couples: those on and below the
/// diagonal, column by column.
struct PointMatrix {
  std::vector<std::size_t> first{0};   // where the blocks of a column begin [points + 1]
  std::vector<std::uint32_t> row;      // ascending in every column, from the diagonal on
  std::vector<Eigen::Matrix3d> block;  // K_(row, column)

  std::size_t points() const { return first.size() - 1; }
};

/// Free degrees of freedom with stiffness, numbered one after the other, those of a point together.
struct Unknowns {
  std::vector<std::int32_t> index;  // by index_in_state(); -1: none
  std::vector<Dof> dof;             // per unknown

  Eigen::Index size() const { return static_cast<Eigen::Index>(dof.size()); }
};

/// `diagonal`: of P^T diag(K) P, zero at held degrees of freedom (Constraints::fold_diagonal). `order`: the points that
/// have unknowns, in the order of those; empty: ascending.
Unknowns unknowns(const Forces& diagonal, const std::vector<int>& order = {});

/// P^T K P: what degrees of freedom that follow others have goes to those.
PointMatrix folded(PointMatrix matrix, const Constraints& constraints);

/// Adds a matrix of the first points of another, times a factor, to it, which has room for its blocks.
void add(const PointMatrix& matrix, double factor, PointMatrix& sum);

/// The product with values of its points [3 x points].
State product(const PointMatrix& matrix, const State& values);

/// Blocks that are zero but for rounding left out; the diagonal stays.
PointMatrix without_rounding(const PointMatrix& matrix);

/// The lower triangle of the matrix of the unknowns.
Eigen::SparseMatrix<double> of_unknowns(const PointMatrix& matrix, const Unknowns& unknowns);

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

/// Sum of the matrix and the elastic supports; the matrix itself where there are none.
PointMatrix with(PointMatrix matrix, const ElasticSupports& elastic_supports);

/// The matrix and a number for every degree of freedom on its diagonal.
PointMatrix plus(PointMatrix matrix, const Forces& diagonal);

}  // namespace plate
