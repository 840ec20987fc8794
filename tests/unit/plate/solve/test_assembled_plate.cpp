#include "plate/solve/factorised_plate.hpp"

#include "plate/galerkin/stiffness.hpp"
#include "plate/model/errors.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"

using namespace plate;
namespace gp = galerkin_plate;

TEST_CASE("assembled plate: equilibrium under several loads at once, with ties and without") {
  const auto cells = gp::cells(gp::with_hole(), 0.1);
  const GalerkinOperator op(gp::families(cells), gp::section);
  const auto outline = gp::with_hole();
  using enum SupportKind;
  const auto boundary =
      galerkin_boundary(cells, op.families().areas, outline,
                        {{clamped, {"left"}, {}}, {simply_supported_hard, {"hole0"}, {}}, {symmetry, {"right"}, {}}});
  REQUIRE_FALSE(boundary.constraints.ties().empty());
  const AssembledPlate plate(op, boundary.constraints, stiffness_matrix(op));
  const std::vector<Forces> loads{gp::random_state(op.points(), 1), gp::random_state(op.points(), 2)};
  const auto states = plate.solve(loads);
  REQUIRE(states.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    Forces rest;
    op.internal_force(states[i], rest);
    rest += loads[i];
    boundary.constraints.fold(rest);
    CHECK(rest.cwiseAbs().maxCoeff() < 1e-9);  // measured: 2e-12
    State imposed = states[i], alone;
    boundary.constraints.impose(imposed);
    CHECK(imposed == states[i]);
    Forces folded = loads[i];
    boundary.constraints.fold(folded);
    plate.apply(folded, alone);
    boundary.constraints.impose(alone);
    CHECK((alone - states[i]).cwiseAbs().maxCoeff() < 1e-12 * states[i].cwiseAbs().maxCoeff());
  }
  CHECK(plate.bytes() > 1000);
}

TEST_CASE("folded diagonal: that of P^T K P, zero where the plate is held") {
  const auto cells = gp::scenes().front();
  const GalerkinOperator op(gp::families(cells), gp::section);
  Constraints constraints;
  constraints.fix(dof_by_points(4));
  constraints.tie(dof_by_points(8), {{dof_by_points(31), -2}});
  constraints.resolve();
  const auto K = gp::stiffness(op.families(), gp::section);
  const auto diagonal = folded_diagonal(op, constraints);
  CHECK(at_dof(diagonal, dof_by_points(4)) == 0);
  CHECK(at_dof(diagonal, dof_by_points(8)) == 0);
  CHECK(at_dof(diagonal, dof_by_points(31)) == Approx(K(31, 31) + 4 * K(8, 8)));
  CHECK(gathered(unknowns(diagonal), diagonal).minCoeff() > 0);
}
