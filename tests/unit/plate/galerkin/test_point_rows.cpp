#include "plate/galerkin/operator.hpp"

#include <numeric>

#include "plate/galerkin/stiffness.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"

using namespace plate;
namespace gp = galerkin_plate;

TEST_CASE("rows of points: the products of the operator, to rounding") {
  for (const auto& cells : gp::scenes()) {
    const GalerkinOperator op(gp::families(cells), gp::section);
    std::vector<std::uint32_t> all(op.points());
    std::iota(all.begin(), all.end(), 0);
    const PointRows rows(stiffness_matrix(op.families(), op.sections()), all);
    const State u = gp::random_state(op.points(), 3);
    Forces own(3, u.cols()), other(3, u.cols());
    rows.internal_force(u, own), op.internal_force(u, other);
    CHECK((own - other).norm() < 1e-13 * own.norm());  // measured: 2e-15
    Forces diagonal(3, u.cols());
    rows.diagonal(diagonal);
    CHECK((diagonal - op.diagonal()).norm() < 1e-13 * own.norm());
    const State positive = u.cwiseAbs();
    rows.absolute_product(positive, own), op.absolute_product(positive, other);
    CHECK((own.array() <= other.array() * (1 + 1e-12)).all());  // families may cancel
    CHECK((own.array() >= -other.array()).all());
    CHECK(rows.bytes() > op.points() * 9 * sizeof(double));
  }
}

TEST_CASE("rows of points: a plate with directions, whose lattice goes by rows, has the products of its whole matrix") {
  Section section = gp::section;
  section.orthotropic = Orthotropy{1000, 300, 0.3, 150, 150, 100, 30};
  for (const auto& cells : gp::scenes()) {
    const GalerkinOperator op(gp::families(cells), section);
    std::vector<std::uint32_t> all(op.points());
    std::iota(all.begin(), all.end(), 0);
    const PointRows rows(stiffness_matrix(op.families(), op.sections()), all);
    const State u = gp::random_state(op.points(), 3);
    Forces own(3, u.cols()), other(3, u.cols()), diagonal(3, u.cols());
    rows.internal_force(u, own), op.internal_force(u, other);
    CHECK((own - other).norm() < 1e-13 * own.norm());
    rows.diagonal(diagonal);
    CHECK((diagonal - op.diagonal()).norm() < 1e-13 * own.norm());
  }
}
