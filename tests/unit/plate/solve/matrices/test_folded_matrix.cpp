#include "tests/catch.hpp"
#include "tests/dense.hpp"
#include "tests/unit/plate/small_plate.hpp"
#include "tests/unit/plate/solve/matrices/random_matrix.hpp"

using namespace plate;

namespace {

/// Degree of freedom by its number where the values of a point stand together.
Dof d(int number) {
  return dof_by_points(number);
}

}  // namespace

TEST_CASE("folded matrix: P^T K P of ties within a point, to others, to two of them and in chains") {
  for (const unsigned seed : {1u, 2u, 3u})
    for (const double share : {0.3, 1.0}) {
      const auto matrix = random_matrix::of(9, share, seed);
      Constraints constraints;
      constraints.fix(d(0)), constraints.fix(d(13));
      constraints.tie(d(4), {{d(5), -0.5}});              // of the same point
      constraints.tie(d(7), {{d(19), 2}});                // to one behind
      constraints.tie(d(20), {{d(1), 0.25}});             // to one ahead
      constraints.tie(d(22), {{d(2), 1}, {d(10), -3}});   // to two
      constraints.tie(d(8), {{d(22), 0.5}, {d(13), 1}});  // to what follows, and to what is fixed
      constraints.tie(d(6), {{d(8), -1}});
      constraints.resolve();
      const auto P = small_plate::prolongation(constraints, 27);
      const Eigen::MatrixXd expected = dense::folded(random_matrix::dense(matrix), P);
      Forces diagonal(3, 9);
      for (Eigen::Index dof = 0; dof < 27; ++dof)
        at_dof(diagonal, dof_by_points(dof)) = !constraints.held(dof_by_points(dof));
      const Eigen::MatrixXd found = of_unknowns(folded(matrix, constraints), unknowns(diagonal));
      REQUIRE(found.rows() == expected.rows());
      const Eigen::MatrixXd lower = expected.triangularView<Eigen::Lower>();
      CHECK((found - lower).cwiseAbs().maxCoeff() < 1e-12);  // measured: 2e-14, of 150
    }
}

TEST_CASE("folded matrix: blocks of rounding go, the diagonal and what is small by its units stays") {
  auto matrix = random_matrix::of(4, 1, 7);
  const auto blocks = matrix.block.size();
  matrix.block[1] *= 1e-14;
  CHECK(without_rounding(matrix).block.size() == blocks - 1);
  for (auto& block : matrix.block) block *= 1e-30;
  CHECK(without_rounding(matrix).block.size() == blocks - 1);
  matrix.block[matrix.first[1]].setZero();  // a point without stiffness
  const auto left = without_rounding(matrix);
  REQUIRE(left.points() == 4);
  for (std::size_t k = 0; k < 4; ++k) CHECK(left.row[left.first[k]] == k);
}
