#include "plate/solve/settled.hpp"

#include <catch2/catch.hpp>

#include "plate/formulation/constraints.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/solve/solution.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;

TEST_CASE("the work of settled supports is the energy of the plate, and what is left is measured by reactions") {
  auto c = vp::free_plate(geometry::rectangle(0, 0, 1, 1), 0.1);
  c.supports = {vp::held(SupportKind::clamped, {"left"}), vp::held(SupportKind::simply_supported, {"right"})};
  Load load;
  load.kind = Load::Kind::settlement, load.support = 1, load.value = 0.1;
  c.loads = {load};
  const auto plate = vp::assembled(c);
  REQUIRE(settles(*plate));
  const auto none = plate->total_load();
  const auto lift = total_lift(*plate);
  const Settled settled(*plate, none, lift);
  const auto found = solve_static(*plate, none, StaticMethod::cg, Preconditioning::automatic, {1e-9, 10000, {}}, lift);
  CHECK(settled.left(found.solution.state).share < 1e-9);
  CHECK(settled.left(lift).share > 0.1);
  CHECK(settled.work(found.solution.state) == Approx(plate->strain_energy(found.solution.state)).epsilon(1e-8));
  CHECK(Settled(*plate, none, State(3, 0)).work(found.solution.state) == 0);
  CHECK(Settled(*plate, none, State(3, 0)).pull() == none);
}
