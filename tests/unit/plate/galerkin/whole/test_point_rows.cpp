#include "plate/galerkin/whole/point_rows.hpp"

#include <catch2/catch.hpp>

#include "plate/galerkin/stiffness.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"

using namespace plate;
namespace gp = galerkin_plate;

TEST_CASE("rows of points: the products of the operator, to rounding") {
  for (const auto& cells : gp::scenes()) {
    const GalerkinOperator op(gp::families(cells), gp::section);
    const PointRows rows(stiffness_matrix(op.families(), op.sections()));
    const State u = gp::random_state(op.points(), 3);
    Forces own(3, u.cols()), other(3, u.cols());
    rows.internal_force(u, own), op.internal_force(u, other);
    CHECK((own - other).norm() < 1e-13 * own.norm());  // measured: 2e-15
    CHECK((rows.diagonal() - op.diagonal()).norm() < 1e-13 * own.norm());
    const State positive = u.cwiseAbs();
    rows.absolute_product(positive, own), op.absolute_product(positive, other);
    CHECK((own.array() <= other.array() * (1 + 1e-12)).all());  // families may cancel
    CHECK((own.array() >= -other.array()).all());
    CHECK(rows.bytes() > op.points() * 9 * sizeof(double));
  }
}
