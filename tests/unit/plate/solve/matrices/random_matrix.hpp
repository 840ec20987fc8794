#pragma once
#include <random>

#include "plate/formulation/constraints.hpp"
#include "plate/solve/matrices/point_matrix.hpp"

/// Symmetric matrices in blocks with random numbers, and the same dense.
namespace random_matrix {

/// A share of all pairs of points is coupled; the diagonal is heavy.
inline plate::PointMatrix of(std::uint32_t points, double share, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  plate::PointMatrix result;
  for (std::uint32_t k = 0; k < points; ++k) {
    for (std::uint32_t j = k; j < points; ++j) {
      if (j > k && value(random) > 2 * share - 1) continue;
      Eigen::Matrix3d block = Eigen::Matrix3d::NullaryExpr([&] { return value(random); });
      if (j == k) block = Eigen::Matrix3d(block + block.transpose() + 4 * points * Eigen::Matrix3d::Identity());
      result.row.push_back(j), result.block.push_back(block);
    }
    result.first.push_back(result.row.size());
  }
  return result;
}

inline Eigen::MatrixXd dense(const plate::PointMatrix& matrix) {
  const auto size = 3 * Eigen::Index(matrix.points());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t k = 0; k < matrix.points(); ++k)
    for (auto b = matrix.first[k]; b < matrix.first[k + 1]; ++b) {
      const auto row = 3 * Eigen::Index(matrix.row[b]), column = 3 * Eigen::Index(k);
      result.block<3, 3>(row, column) = matrix.block[b];
      result.block<3, 3>(column, row) = matrix.block[b].transpose();
    }
  return result;
}

}  // namespace random_matrix
