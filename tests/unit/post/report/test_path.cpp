#include "post/report/accuracy_search.hpp"

#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("path: half the size halves the points far from tips, and quarters those at tips") {
  const auto c = read(plain, {"geometry.holes=[{circle=[0,-0.6,0.1]}]"}).content;
  const auto first = post::discretization_of(c, false, 1), second = post::discretization_of(c, false, 0.5);
  CHECK(second.spacing == Approx(first.spacing / 2));
  CHECK(*second.tip_spacing == Approx(*first.tip_spacing / 4));
  CHECK(*second.hole_spacing == Approx(*first.hole_spacing / 2));
  CHECK(second.spacing_growth == Approx(first.spacing_growth / 2));
  CHECK(post::discretization_of(c, true, 1).spacing < first.spacing);  // waves have to cross the plate
}
