#include "plate/solve/matrices/point_matrix.hpp"

#include "tests/catch.hpp"

using namespace plate;

namespace {

Eigen::MatrixXd dense(const PointMatrix& matrix) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(Eigen::Index(3 * matrix.points()), Eigen::Index(3 * matrix.points()));
  for (std::size_t k = 0; k < matrix.points(); ++k)
    for (auto i = matrix.first[k]; i < matrix.first[k + 1]; ++i) {
      const auto row = Eigen::Index(3 * matrix.row[i]), column = Eigen::Index(3 * k);
      result.block<3, 3>(row, column) = matrix.block[i];
      result.block<3, 3>(column, row) = matrix.block[i].transpose();
    }
  return result;
}

}  // namespace

TEST_CASE("a matrix with what is attached couples what either couples") {
  auto matrix = zeros(5, [](Column& column, std::uint32_t k) { column.couple(std::min(4U, k + 1)); });
  for (std::size_t i = 0; i < matrix.block.size(); ++i) matrix.block[i].setConstant(double(i + 1));
  for (std::size_t k = 0; k < 5; ++k) matrix.block[matrix.first[k]].setIdentity();
  ElasticSupportSum sum(5);
  sum.add(2, {{dof(0, 0), 1}, {dof(4, 2), -1}});
  sum.add(3, {{dof(1, 1), 1}, {dof(2, 0), 1}});
  std::vector<ElasticSupport> parts;
  parts.push_back(std::move(sum).taken("spring0", {}));
  const ElasticSupports elastic_supports(std::move(parts));
  Eigen::MatrixXd expected = dense(matrix);
  expected(0, 0) += 2, expected(14, 14) += 2, expected(0, 14) -= 2, expected(14, 0) -= 2;
  expected(4, 4) += 3, expected(6, 6) += 3, expected(4, 6) += 3, expected(6, 4) += 3;
  CHECK(dense(with(matrix, elastic_supports)) == expected);
  CHECK(dense(with(matrix, {})) == dense(matrix));
}
