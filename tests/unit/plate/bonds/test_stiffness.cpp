#include "plate/bonds/stiffness.hpp"

#include <omp.h>

#include <algorithm>

#include "plate/galerkin/stiffness.hpp"
#include "plate/solve/factorised_plate.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;
namespace gp = galerkin_plate;

namespace {

/// All degrees of freedom.
Eigen::MatrixXd dense_point_matrix(const PointMatrix& matrix) {
  const auto size = Eigen::Index(3 * matrix.points());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t k = 0; k < matrix.points(); ++k)
    for (auto b = matrix.first[k]; b < matrix.first[k + 1]; ++b) {
      const auto row = Eigen::Index(3 * matrix.row[b]), column = Eigen::Index(3 * k);
      result.block<3, 3>(row, column) = matrix.block[b];
      result.block<3, 3>(column, row) = matrix.block[b].transpose();
    }
  return result;
}

/// K by the force that unit displacements need.
Eigen::MatrixXd by_products(const Operator& plate) {
  const auto points = Eigen::Index(plate.points());
  Eigen::MatrixXd K(3 * points, 3 * points);
  State unit = State::Zero(3, points);
  Forces forces;
  for (Eigen::Index n = 0; n < K.cols(); ++n) {
    at_dof(unit, dof_by_points(n)) = 1;
    plate.internal_force(unit, forces);
    at_dof(unit, dof_by_points(n)) = 0;
    K.col(n) = -forces.reshaped<Eigen::ColMajor>();
  }
  return K;
}

/// A held plate with edges at angles to the axes, where rotations follow each other.
Boundary held_boundary(const geometry::Tessellation& cells, const GalerkinFamilies& families,
                       const geometry::Outline& outline) {
  return galerkin_boundary(cells, families.areas, geometry::to_lattice(outline, cells.units),
                           {{SupportKind::simply_supported_hard, {"edge0", "edge2"}, {}}});
}

geometry::Outline kite() {
  return {{{{0.0, 0.0}, {0.5, -0.5}, {1.5, 0.5}, {1.0, 1.0}}, {"edge0", "edge1", "edge2", "edge3"}}, {}};
}

}  // namespace

TEST_CASE("stiffness of the Galerkin plate: what its products say, by blocks") {
  for (const auto& cells : gp::scenes()) {
    const GalerkinOperator op(gp::families(cells), gp::section);
    const Eigen::MatrixXd K = by_products(op);
    CHECK((dense_point_matrix(stiffness_matrix(op)) - K).cwiseAbs().maxCoeff() <
          1e-13 * K.cwiseAbs().maxCoeff());  // measured: 4e-16
  }
}

TEST_CASE("folded stiffness: P^T K P where rotations at an oblique edge follow each other") {
  const auto outline = kite();
  const auto cells = gp::cells(outline, 0.125);
  const GalerkinOperator op(gp::families(cells), gp::section);
  const auto boundary = held_boundary(cells, op.families(), outline);
  REQUIRE(!boundary.constraints.ties().empty());
  const Eigen::MatrixXd P = small_plate::prolongation(boundary.constraints, Eigen::Index(3 * op.points()));
  const Eigen::MatrixXd expected = P.transpose() * by_products(op) * P;
  const auto matrix = folded(stiffness_matrix(op), boundary.constraints);
  const Forces diagonal = folded_diagonal(op, boundary.constraints);
  const auto lower = of_unknowns(matrix, unknowns(diagonal));
  const Eigen::MatrixXd found = Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
  REQUIRE(found.rows() == expected.rows());
  CHECK((found - expected).norm() < 1e-13 * expected.norm());  // measured: 3e-16

  // the same in an order of elimination
  const auto order = elimination_order(matrix, diagonal);
  const auto eliminated = unknowns(diagonal, order);
  const Eigen::MatrixXd permuted = Eigen::MatrixXd(of_unknowns(matrix, eliminated)).selfadjointView<Eigen::Lower>();
  const auto ascending = unknowns(diagonal);
  REQUIRE(eliminated.size() == ascending.size());
  const auto at = [&](Eigen::Index u) {
    return ascending.index[index_in_state(eliminated.dof[std::size_t(u)], matrix.points())];
  };
  for (Eigen::Index u = 0; u < permuted.rows(); ++u)
    for (Eigen::Index v = 0; v < permuted.cols(); ++v) REQUIRE(permuted(u, v) == found(at(u), at(v)));
}

TEST_CASE("order of elimination: every point with unknowns once") {
  const auto outline = geometry::rectangle(0, 0, 3, 2);
  const auto cells = gp::cells(outline, 0.1);
  const GalerkinOperator op(gp::families(cells), gp::section);
  const auto boundary = galerkin_boundary(cells, op.families().areas, geometry::to_lattice(outline, cells.units),
                                          {{SupportKind::clamped, {"left", "right"}, {}}});
  const Forces diagonal = folded_diagonal(op, boundary.constraints);
  auto order = elimination_order(folded(stiffness_matrix(op), boundary.constraints), diagonal);
  std::vector<int> expected;
  for (Eigen::Index k = 0; k < diagonal.cols(); ++k)
    if (diagonal.col(k).maxCoeff() > 0) expected.push_back(int(k));
  REQUIRE(expected.size() < op.points());
  std::sort(order.begin(), order.end());
  CHECK(order == expected);
}

TEST_CASE("any number of threads gives the same stiffness") {
  const auto cells = gp::cells(gp::with_hole(), 0.04, {{{0.8, 0.42}, {1.0, 0.47}}}, {0.01, 0.02, 0.3});
  const GalerkinOperator op(gp::families(cells), gp::section);
  const auto m = small_plate::model(geometry::rectangle(0, 0, 3, 2), {}, small_plate::spaced(0.1));
  const int before = omp_get_max_threads();
  const auto all = [&](int threads) {
    omp_set_num_threads(threads);
    return std::array{stiffness_matrix(op), stiffness_matrix(m.plate, true)};
  };
  const auto one = all(1), three = all(3);
  omp_set_num_threads(before);
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(one[i].row == three[i].row);
    CHECK(one[i].block == three[i].block);
  }
}
