#include "post/report/singular_places.hpp"

#include <cmath>

#include "cases/driver/prepared.hpp"
#include "cases/driver/run.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/statics.hpp"
#include "post/files/frame.hpp"
#include "post/report/conclusion.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/post/small_run.hpp"

using case_text::plain;
using case_text::read;

namespace {

post::Summary run_case(const std::vector<std::string>& settings) {
  const small_run::TemporaryFolder folder;
  return cases::run(read(plain, settings), {folder / "run", true});
}

}  // namespace

TEST_CASE("singular places: tips, corners, pins, springs and point forces, by their names") {
  const auto file =
      read(plain, {"discretization.spacing=0.1", "geometry.outline={polygon=[[0,0],[2,0],[2,1],[1,1],[1,2],[0,2]]}",
                   "geometry.cracks=[[[0.3,0.5],[0.7,0.5]]]", "support[0].edges=['edge0']",
                   "support[1]={kind='pinned',points=[[0.2,1.7]]}",
                   "load[1]={kind='point_force',position=[1.5,0.5],value=1}"});
  const auto plate = cases::discretised(file).plate;
  std::vector<std::string> names;
  bool corner = false;
  for (const auto& [name, x] : post::singular_places(*plate)) {
    names.push_back(name);
    corner = corner || (name == "corner" && (x - geometry::Point(1, 1)).norm() < 1e-12);
  }
  CHECK(corner);
  for (const char* name : {"tip 0", "tip 1", "pin0", "point force"})
    CHECK(std::ranges::find(names, name) != names.end());
}

TEST_CASE("stress at a distance from tips: alike at both, as K over the root of the distance, in both formulations") {
  for (const std::string formulation : {"galerkin", "ordinary"}) {
    const auto file = read(
        plain, {"discretization.spacing=0.025", "discretization.formulation=" + formulation, "section.thickness=0.02",
                "section.poisson=0.2", "load=[{kind='edge_moment',edges=['right'],value=1}]",
                "geometry.cracks=[[[0.0,-0.4],[0.0,0.4]]]"});
    const auto plate = cases::discretised(file).plate;
    const auto state = plate::static_solution(*plate, file.content.analysis, {1e-9, 20000, {}}).solution.state;
    const auto frame = post::frame_of(*plate, 0, 0, state, true);
    std::vector<double> values;
    for (const double distance : {0.24, 0.12, 0.06}) {
      const auto all = post::StressAround(*plate, distance).take(frame);
      std::vector<double> tips;
      for (const auto& one : all)
        if (one.place.starts_with("tip")) {
          CHECK(one.resolved);
          CHECK((one.position - one.singular).norm() == Approx(distance));
          tips.push_back(one.value);
        }
      CAPTURE(formulation, distance, tips);
      REQUIRE(tips.size() == 2);
      CHECK(tips[0] == Approx(tips[1]).epsilon(1e-5));  // measured below
      values.push_back(tips[0]);
    }
    CAPTURE(formulation, values);
    CHECK(values[1] / values[0] == Approx(std::sqrt(2)).epsilon(0.2));
    CHECK(values[2] / values[1] == Approx(std::sqrt(2)).epsilon(0.2));
    CHECK(!post::StressAround(*plate, 0.03).take(frame).front().resolved);
    CHECK(post::StressAround(*plate, 3).none());  // outside of the plate
  }
}

TEST_CASE("stress at a distance: in the summary of a run with its error, and the largest stress keeps the distance") {
  const auto near = run_case({"output.stress_distance=0.2"}), standard = run_case({"discretization.spacing=0.025"});
  REQUIRE(near.stress_near.size() >= 2);
  for (const auto& one : near.stress_near) {
    CHECK(one.distance == 0.2);
    CHECK(one.error.value() > 0);
  }
  CHECK(*near.extremes[1].outside == 0.2);
  REQUIRE(!standard.stress_near.empty());
  CHECK(standard.stress_near.front().distance == 0.1);  // the thickness
  // with a quarter of the points a way inside the error
  const auto fine = run_case({"output.stress_distance=0.2", "discretization.spacing=0.0125"});
  for (std::size_t i = 0; i < near.stress_near.size(); ++i) {
    const auto &one = near.stress_near[i], &truth = fine.stress_near[i];
    CAPTURE(one.place, one.value, truth.value, *one.error);
    CHECK(std::abs(one.value - truth.value) < *one.error);
  }
}
