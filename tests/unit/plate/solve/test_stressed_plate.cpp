#include "plate/solve/buckling.hpp"

#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"

using namespace plate;
namespace gp = galerkin_plate;

TEST_CASE("stressed plate: products are those of the plate and of its membrane forces") {
  for (const auto& cells : gp::scenes()) {
    const GalerkinOperator op(gp::families(cells), gp::section);
    const auto K = stiffness_matrix(op);
    const StressedPlate twice(op, K);
    const State u = gp::random_state(op.points(), 3);
    Forces own, both;
    op.internal_force(u, own), twice.internal_force(u, both);
    CHECK((both - 2 * own).norm() < 1e-12 * own.norm());
    CHECK((twice.diagonal() - 2 * op.diagonal()).norm() < 1e-12 * op.diagonal().norm());
    op.absolute_product(u.cwiseAbs(), own), twice.absolute_product(u.cwiseAbs(), both);
    CHECK((both.array() >= own.array()).all());
  }
}
