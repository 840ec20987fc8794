#include "post/factors/watched_motion.hpp"

#include "plate/formulation/discretised.hpp"
#include "post/factors/plate_factors.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("watched motion: more vectors where the factors of the tips are to be held, an entry for each tip") {
  const auto moving = with_line(with_line(plain, 17, "kind = \"dynamic\"\nduration = 0.05\nmethod = \"lanczos\""), 4,
                                "thickness = 0.1\ndensity = 1");
  const auto c = read(moving + "[srif]\n", {"discretization.spacing=0.1"}).content;
  const auto plate = plate::discretise(c).plate;
  const auto methods = post::tip_methods(*plate, *c.srif);
  const auto loose = post::lanczos_motion(c.analysis, *plate, methods, INFINITY, {});
  const auto watched = post::lanczos_motion(c.analysis, *plate, methods, 1e-3, {});
  CHECK(loose.truncated().size() == 2);
  CHECK(watched.vectors() >= loose.vectors());
}
