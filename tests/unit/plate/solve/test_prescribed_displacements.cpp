#include "plate/solve/prescribed_displacements.hpp"

#include "plate/formulation/constraints.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/solve/statics.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;

TEST_CASE("the work of settled supports is the energy of the plate, and what is left is measured by reactions") {
  auto c = vp::free_plate(geometry::rectangle(0, 0, 1, 1), 0.1);
  c.supports = {vp::held(SupportKind::clamped, {"left"}), vp::held(SupportKind::simply_supported, {"right"})};
  c.loads = {Load{Settlement{.support = 1, .value = 0.1}}};
  const auto plate = vp::assembled(c);
  REQUIRE(has_prescribed_displacements(*plate));
  const auto none = plate->total_load();
  const auto lift = total_lift(*plate);
  const PrescribedDisplacements prescribed(*plate, none, lift);
  const auto found = solve_static(*plate, none, StaticMethod::cg, Preconditioning::automatic, {1e-9, 10000, {}}, lift);
  CHECK(prescribed.residual(found.solution.state).share < 1e-9);
  CHECK(prescribed.residual(lift).share > 0.1);
  CHECK(prescribed.work(found.solution.state) == Approx(plate->strain_energy(found.solution.state)).epsilon(1e-8));
  CHECK(PrescribedDisplacements(*plate, none, State(3, 0)).work(found.solution.state) == 0);
  CHECK(PrescribedDisplacements(*plate, none, State(3, 0)).pull() == none);
}

namespace {

Load moved(std::size_t support, double value, const geometry::Point& slope = {0, 0}) {
  return {Settlement{.support = support, .value = value, .slope = slope}};
}

cases::Case two_edges(const std::vector<Load>& loads) {
  auto c = vp::free_plate(geometry::rectangle(0, 0, 1, 1), 0.1);
  c.supports = {vp::held(SupportKind::clamped, {"left"}), vp::held(SupportKind::simply_supported, {"right"})};
  c.loads = loads;
  return c;
}

}  // namespace

TEST_CASE("settlements that move all supports as one body leave nothing beside it, others leave their difference") {
  const geometry::Point slope(0.2, -0.1);
  const auto together = vp::assembled(two_edges({moved(0, 0.3, slope), moved(1, 0.3, slope)}));
  const auto parts = split_lift(*together, total_lift(*together));
  CHECK(parts.rest.isZero(0));
  CHECK(parts.rigid(0, 0) == Approx(0.3 + slope.dot(together->cloud().positions[0])).epsilon(1e-13));
  const auto apart = vp::assembled(two_edges({moved(0, 0.3, slope), moved(1, 0.4, slope)}));
  CHECK(split_lift(*apart, total_lift(*apart)).rest.cwiseAbs().maxCoeff() < 0.1);
  CHECK_FALSE(split_lift(*apart, total_lift(*apart)).rest.isZero(0.01));
  CHECK(split_lift(*apart, State(3, 0)).rigid.cols() == 0);
  auto c = two_edges({moved(0, 0.3)});
  c.foundations.emplace_back();
  c.foundations.back().modulus = 1;
  const auto on_soil = vp::assembled(c);
  CHECK(split_lift(*on_soil, total_lift(*on_soil)).rigid.cols() == 0);  // soil resists rigid motions
}

TEST_CASE("loads that cancel are no load, but a part of them is") {
  auto c = two_edges({});
  c.loads = {Load{Pressure{.value = 1}}, Load{Pressure{.formula = Formula("-1 - 0.3*x + 0.3*x")}}};
  const auto plate = vp::assembled(c);
  CHECK(acting_load(*plate).isZero(0));
  CHECK(cancel(*plate, {plate->loads()[0].forces, plate->loads()[1].forces}));
  CHECK_FALSE(cancel(*plate, {plate->loads()[0].forces}));
  CHECK_FALSE(cancel(*plate, {plate->loads()[0].forces, 0.999999 * plate->loads()[1].forces}));
}
