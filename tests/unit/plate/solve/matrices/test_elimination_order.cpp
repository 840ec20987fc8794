#include "plate/solve/matrices/factor.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/solve/matrices/random_matrix.hpp"

using namespace plate;

TEST_CASE("elimination order: every point with unknowns once, and what all depend on last") {
  auto star = random_matrix::of(40, 0, 1);  // no pair is coupled ...
  PointMatrix matrix;
  for (std::uint32_t k = 0; k < 40; ++k) {  // ... but all with point 0
    matrix.row.push_back(k), matrix.block.push_back(star.block[k]);
    for (std::uint32_t j = k + 1; k == 0 && j < 40; ++j)
      matrix.row.push_back(j), matrix.block.push_back(Eigen::Matrix3d::Ones());
    matrix.first.push_back(matrix.row.size());
  }
  Forces diagonal = Forces::Ones(3, 40);
  diagonal.col(17).setZero();
  diagonal.col(18) << 0, 0, 1;
  auto order = elimination_order(matrix, diagonal);
  REQUIRE(order.size() == 39);
  CHECK(std::ranges::find(order, 0) >= order.end() - 2);
  const auto good = unknowns(diagonal, order), bad = unknowns(diagonal);
  CHECK(Factor(of_unknowns(matrix, good)).bytes() < Factor(of_unknowns(matrix, bad)).bytes() / 2);
  std::ranges::sort(order);
  for (int i = 0, k = 0; i < 39; ++i, ++k) CHECK(order[std::size_t(i)] == (k == 17 ? ++k : k));
}

TEST_CASE("elimination order: of points that are all held there is none") {
  CHECK(elimination_order(random_matrix::of(3, 1, 1), Forces::Zero(3, 3)).empty());
}
