#include "plate/solve/pushing_supports.hpp"

#include "cases/input/case_file.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/problem.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace plate;

TEST_CASE("supports that only push: a pressed square leaves them at its corners, without gaps it is held as before") {
  for (const std::string pushes : {"up", "down"}) {
    INFO(pushes);
    const auto plate =
        discretise(case_text::read(case_text::plain,
                                   {"geometry.cracks=[]", "discretization.spacing=0.1", "load[0].value=-1",
                                    "support=[{ kind = 'simply_supported', edges = ['left', 'right', 'bottom', "
                                    "'top'], pushes = '" +
                                        pushes + "' }]"})
                       .content)
            .plate;
    PushingSupports pushing(*plate);
    const Forces load = pushes == "up" ? Forces(plate->total_load()) : Forces(-plate->total_load());
    const auto gaps = pushing(load, no_state());
    CHECK(gaps.lifted.share > 0.1);
    CHECK(gaps.lifted.share < 0.7);
    CHECK(gaps.lifted.largest_gap > 0);
    const double sign = pushes == "up" ? 1 : -1;
    CHECK((sign * gaps.lift.row(0)).minCoeff() >= 0);
    CHECK((sign * gaps.lift.row(0)).maxCoeff() == Approx(gaps.lifted.largest_gap));
  }
}
