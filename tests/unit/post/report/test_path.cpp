#include "post/report/accuracy_search.hpp"

#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "post/report/terminal.hpp"
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

TEST_CASE("path: where two steps at once end worse, the step between is tried, and the best of all is given") {
  const auto file = read(plain, {"discretization.spacing=0.1", "discretization.formulation=galerkin"});
  auto c = file.content;
  c.discretization.tip_spacing = 0.1;
  const auto plate = plate::discretise(c).plate;
  post::SrifOptions options;
  options.accuracy = 1e-4, options.accuracy_seconds = 600;
  std::vector<double> sizes;
  const auto solve = [&](double size) -> std::variant<post::AccuracyTrial, post::Infeasible> {
    sizes.push_back(size);
    if (size < 0.2) return post::Infeasible{"so fine"};
    post::AccuracyTrial trial{plate.get(), {{}}, {}, 1, 0};
    for (std::size_t tip = 0; tip < plate->tips().size(); ++tip)
      for (const auto method : {post::SrifMethod::domain_integral, post::SrifMethod::virtual_crack_extension,
                                post::SrifMethod::series_fit}) {
        const double side = method == post::SrifMethod::domain_integral ? 1 : -1;
        post::Srif srif;
        srif.tip = tip, srif.method = method, srif.G = 1, srif.K3 = 0;
        srif.K1 = 2 + 0.1 * side * size * size + (size < 0.3 ? 0.5 : 0);  // the finest of all is off
        srif.K2 = 0.01 * size * size;
        trial.rows.front().push_back(srif);
      }
    return trial;
  };
  post::Progress progress(true, "");
  const auto found = post::refine(options, solve, progress);
  REQUIRE(sizes.size() > 4);
  const auto finest = std::ranges::find_if(sizes, [](double size) { return size < 0.3; });
  REQUIRE(finest + 1 < sizes.end());
  CHECK(*(finest + 1) == Approx(*finest * std::sqrt(2.0)));
  CHECK(found.refined.front().front().K1 == Approx(2).epsilon(1e-3));
}
