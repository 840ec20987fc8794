#include "plate/solve/plate_in_contact.hpp"

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;

TEST_CASE("a plate whose soil touches where it is pressed is the plate, and is linear") {
  auto c = vp::free_plate(geometry::rectangle(0, 0, 1, 1), 0.1);
  c.foundations = {{30, 0, {}, true}};
  c.loads = {Load{Pressure{.value = 1}}};
  const auto plate = vp::assembled(c);
  const auto& elastic_supports = plate->boundary().elastic_supports;
  const auto u = vp::random_state(*plate, 1), v = vp::random_state(*plate, 2);
  const auto force = [](const Operator& op, const State& state) {
    Forces result;
    op.internal_force(state, result);
    return result;
  };
  const PlateInContact touched(*plate, elastic_supports, elastic_supports.touching(u));
  CHECK((force(touched, u) - force(*plate, u)).norm() < 1e-12 * force(*plate, u).norm());
  CHECK((force(touched, u + v) - force(touched, u) - force(touched, v)).norm() < 1e-12 * force(*plate, u).norm());
  const auto all = everywhere(elastic_supports);
  REQUIRE(all.size() == 1);
  CHECK(std::ranges::count(all[0], 1) == std::ptrdiff_t(elastic_supports.parts()[0]->contact->places()));
}
