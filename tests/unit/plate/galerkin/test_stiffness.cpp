#include "plate/galerkin/stiffness.hpp"

#include <omp.h>

#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"
#include "tests/unit/plate/solve/matrices/random_matrix.hpp"

using namespace plate;
namespace gp = galerkin_plate;

TEST_CASE("Galerkin stiffness: the forces of the plate, row by row, with the same bits for any number of threads") {
  for (const auto& cells : gp::scenes()) {
    const GalerkinOperator op(gp::families(cells), gp::section);
    const int before = omp_get_max_threads();
    omp_set_num_threads(1);
    const auto matrix = stiffness_matrix(op);
    omp_set_num_threads(3);
    const auto again = stiffness_matrix(op);
    omp_set_num_threads(before);
    CHECK(matrix.row == again.row);
    CHECK(matrix.block == again.block);
    const State u = gp::random_state(op.points(), 7);
    Forces force;
    op.internal_force(u, force);
    const Eigen::VectorXd found = random_matrix::dense(matrix) * u.reshaped();
    CHECK((found + force.reshaped()).cwiseAbs().maxCoeff() < 1e-12 * force.cwiseAbs().maxCoeff());  // measured: 2e-15
    for (std::size_t k = 0; k < matrix.points(); ++k) {
      CHECK(matrix.row[matrix.first[k]] == k);
      CHECK(std::is_sorted(matrix.row.begin() + std::ptrdiff_t(matrix.first[k]),
                           matrix.row.begin() + std::ptrdiff_t(matrix.first[k + 1])));
    }
  }
}
