#include "plate/solve/matrices/point_matrix.hpp"

#include "tests/catch.hpp"
#include "tests/unit/plate/solve/matrices/random_matrix.hpp"

using namespace plate;

namespace {

std::vector<Dof> dofs(const std::vector<int>& numbers) {
  std::vector<Dof> result;
  for (const int one : numbers) result.push_back(dof_by_points(one));
  return result;
}

Eigen::Index number(const Dof& dof) {
  return index_by_points(Eigen::Index(dof.point), dof.component);
}

}  // namespace

TEST_CASE("unknowns: degrees of freedom with stiffness, those of a point together, in any order of points") {
  Forces diagonal = Forces::Ones(3, 4);
  diagonal(1, 0) = 0;
  diagonal.col(2).setZero();
  const auto ascending = unknowns(diagonal);
  CHECK(ascending.dof == dofs({0, 2, 3, 4, 5, 9, 10, 11}));
  const auto turned = unknowns(diagonal, {3, 0, 1});
  CHECK(turned.dof == dofs({9, 10, 11, 0, 2, 3, 4, 5}));
  for (const auto& one : {ascending, turned}) {
    REQUIRE(one.index.size() == 12);
    for (std::size_t i = 0; i < one.dof.size(); ++i) CHECK(one.index[index_in_state(one.dof[i], 4)] == std::int32_t(i));
    CHECK(std::ranges::count(one.index, -1) == 4);
  }
}

TEST_CASE("of unknowns: the lower triangle, whatever their order, of their rows and columns alone") {
  const auto matrix = random_matrix::of(5, 0.6, 11);
  const auto all = random_matrix::dense(matrix);
  Forces diagonal = Forces::Ones(3, 5);
  diagonal(0, 1) = diagonal(2, 4) = 0;
  for (const auto& order : {std::vector<int>{}, std::vector<int>{4, 2, 0, 1, 3}}) {
    const auto numbers = unknowns(diagonal, order);
    const Eigen::MatrixXd found = of_unknowns(matrix, numbers);
    for (Eigen::Index i = 0; i < numbers.size(); ++i)
      for (Eigen::Index j = 0; j < numbers.size(); ++j)
        CHECK(found(i, j) ==
              (i < j ? 0 : all(number(numbers.dof[std::size_t(i)]), number(numbers.dof[std::size_t(j)]))));
  }
}
