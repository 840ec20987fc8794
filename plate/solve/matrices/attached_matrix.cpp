#include "plate/solve/matrices/attached_matrix.hpp"

#include <map>

#include "plate/solve/matrices/matrix_pattern.hpp"

namespace plate {

PointMatrix with(PointMatrix matrix, const AttachedStiffness& attached) {
  if (attached.parts().empty()) return matrix;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Eigen::Matrix3d> blocks;  // column, row: on and below the diagonal
  for (const auto& part : attached.parts())
    part->for_each([&](std::uint32_t row, std::uint32_t column, double value) {
      if (row / 3 < column / 3) return;
      const auto [entry, fresh] = blocks.try_emplace({column / 3, row / 3}, Eigen::Matrix3d::Zero());
      entry->second(row % 3, column % 3) += value;
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
