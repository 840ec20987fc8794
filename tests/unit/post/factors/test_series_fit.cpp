#include "post/factors/series_fit.hpp"

#include <algorithm>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/tip_view.hpp"
#include "post/factors/tip_integrals.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/case_text.hpp"

TEST_CASE("series fit: the points of a symmetric plate are symmetric, also where the circle goes through some") {
  const auto file = case_text::read(
      case_text::plain, {"discretization.spacing=0.1", "section.thickness=0.5", "discretization.formulation=ordinary",
                         "geometry.outline={rectangle=[-3,-3,3,3]}", "geometry.cracks=[[[-1,0],[1,0]]]"});
  const auto plate = plate::discretise(file.content).plate;
  const auto view = plate->tip_view();
  std::vector<std::size_t> counts;
  for (const auto& tip : plate->tips()) {
    const auto clear = post::clear_distance(file.content.outline, plate->paths(), tip, view->spacing);
    const auto range = post::fit_range(view->section, clear, view->spacing, view->graded);
    REQUIRE(range);
    REQUIRE(range->outer / view->spacing == Approx(std::sqrt(4.5 * 4.5 + 6.5 * 6.5)).epsilon(1e-12));
    for (const auto& fit : post::series_fits(*view, post::centred(tip, *view), *range, {1, 0.8})) {
      const auto above =
          std::ranges::count_if(fit.points, [&](auto k) { return view->positions[k].y() > tip.position.y(); });
      CHECK(2 * std::size_t(above) == fit.points.size());
      counts.push_back(fit.points.size());
    }
  }
  REQUIRE(counts.size() == 4);
  CHECK(counts[0] == counts[2]);
  CHECK(counts[1] == counts[3]);
}
