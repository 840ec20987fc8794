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

TEST_CASE(
    "path: factors in the plane are refined as those of bending, unless one kind is next to nothing at the faces") {
  const auto file = read(plain, {"discretization.spacing=0.1", "discretization.formulation=galerkin"});
  auto c = file.content;
  c.discretization.tip_spacing = 0.1;
  const auto plate = plate::discretise(c).plate;
  post::SrifOptions options;
  options.accuracy = 0.01, options.accuracy_seconds = 600;
  // sizes until the accuracy is reached; both integrals are off by a share of the factor at the size 1
  const auto sizes = [&](double K, double off_K, double N, double off_N) {
    const auto rows = [&](double factor, double off, double size) {
      std::vector<post::Srif> row;
      for (std::size_t tip = 0; tip < plate->tips().size(); ++tip)
        for (const auto method : {post::SrifMethod::domain_integral, post::SrifMethod::virtual_crack_extension,
                                  post::SrifMethod::series_fit}) {
          post::Srif& srif = row.emplace_back();
          srif.tip = tip, srif.method = method, srif.G = factor * factor;
          srif.K1 = factor * (1 + (method == post::SrifMethod::domain_integral ? off : -off) * size * size);
        }
      return std::vector<std::vector<post::Srif>>{row};
    };
    const auto solve = [&](double size) -> std::variant<post::AccuracyTrial, post::Infeasible> {
      post::AccuracyTrial trial{plate.get(), rows(K, off_K, size), {}, 1, 0};
      if (N > 0) trial.rows_in_plane = rows(N, off_N, size), trial.energy_in_plane = 1;
      return trial;
    };
    post::Progress progress(true, "");
    const auto found = post::refine(options, solve, progress);
    CHECK(found.summary.ended_by.empty());
    CHECK(found.refined_in_plane.size() == (N > 0 ? 1 : 0));
    if (N > 0) CHECK(found.refined_in_plane.front().front().K1 == Approx(N));
    return found.summary.path.size();
  };
  const double at_faces = 6 / c.section.thickness;  // N that counts as much as K = 1
  const auto few = sizes(2, 0.1, 0, 0);
  CHECK(few == 3);
  CHECK(sizes(2, 0.1, at_faces, 0.1) == few);
  CHECK(sizes(2, 0.1, at_faces, 1) > few);
  CHECK(sizes(2, 1, at_faces, 0.1) > few);
  CHECK(sizes(2, 0.1, 1e-4 * at_faces, 1) == few);
  CHECK(sizes(2, 1, 1e5 * at_faces, 0.1) == few);
  CHECK(sizes(0, 0, at_faces, 0.1) == few);  // loads in the plane alone
}
