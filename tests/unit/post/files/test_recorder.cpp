#include "post/files/recorder.hpp"

#include "cases/driver/prepared.hpp"
#include "plate/formulation/formulation.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("points without cells are those of the cells that are drawn") {
  for (const char* formulation : {"ordinary", "galerkin"}) {
    INFO(formulation);
    const auto plate =
        cases::discretised(read(plain, {std::string("discretization.formulation=") + formulation})).plate;
    const auto points = post::points_of(*plate), drawn = plate->mesh();
    CHECK(points.positions == drawn.positions);
    CHECK(points.areas == drawn.areas);
    CHECK(points.cut == drawn.cut);
    CHECK(points.spacing == drawn.spacing);
    CHECK(points.thickness == drawn.thickness);
    CHECK(points.quads.size() + points.triangles.size() + points.corners.size() == 0);
    CHECK(drawn.quads.size() + drawn.triangles.size() > 0);
  }
}
