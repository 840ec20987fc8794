#include "post/factors/accuracy.hpp"
#include "tests/catch.hpp"

using namespace post;

namespace {

constexpr double coarse_spacing = 0.1;

Srif factors(SrifMethod method, double K1, double K2, double K3) {
  Srif result;
  result.method = method;
  result.K1 = K1, result.K2 = K2, result.K3 = K3;
  if (method != SrifMethod::series_fit) result.G = 1;
  return result;
}

/// K of both integrals with errors that go with size^2, of their own size and sign.
AccuracyStep step(double size, const Eigen::Vector3d& K, const Eigen::Vector3d& domain,
                  const Eigen::Vector3d& extension) {
  AccuracyStep result;
  result.size = size;
  const Eigen::Vector3d D = K + size * size * domain, V = K + size * size * extension;
  result.rows = {{factors(SrifMethod::domain_integral, D[0], D[1], D[2]),
                  factors(SrifMethod::virtual_crack_extension, V[0], V[1], V[2]),
                  factors(SrifMethod::series_fit, D[0], D[1], D[2])}};
  return result;
}

std::vector<AccuracyStep> path(std::initializer_list<double> sizes, const Eigen::Vector3d& domain,
                               const Eigen::Vector3d& extension) {
  std::vector<AccuracyStep> result;
  for (const double size : sizes) result.push_back(step(size, {2, -0.5, 3}, domain, extension));
  return result;
}

}  // namespace

TEST_CASE("accuracy: factors whose errors go with the square of the lengths are found exactly, whatever the steps") {
  for (const auto& sizes : {std::initializer_list<double>{1, 0.7, 0.5}, {1, 0.5, 0.25, 0.2}}) {
    const auto rows = refined(path(sizes, {-0.1, 0.03, 0.4}, {0.2, 0.01, 0.4}), coarse_spacing);
    REQUIRE(rows.size() == 1);
    const auto& found = rows[0];
    REQUIRE(found.size() == 1);
    CHECK(found[0].method == SrifMethod::refinement);
    CHECK(found[0].K1 == Approx(2).epsilon(1e-12));
    CHECK(found[0].K2 == Approx(-0.5).epsilon(1e-12));
    CHECK(found[0].K3 == Approx(3).epsilon(1e-12));
    for (const auto& error : found[0].errors) CHECK(*error > 0);
  }
}

TEST_CASE("accuracy: errors of the first order are within the estimate though the result takes them for second") {
  std::vector<AccuracyStep> path;
  for (const double size : {1.0, 0.7071, 0.5, 0.3536}) {
    path.push_back(
        step(1, {2, -0.5, 3}, size * Eigen::Vector3d(-0.1, 0.03, 0.3), size * Eigen::Vector3d(0.08, 0.02, 0.3)));
    path.back().size = size;
  }
  const auto found = refined(path, coarse_spacing).at(0).at(0);
  CHECK(std::abs(found.K1 - 2) < *found.errors[0]);
  CHECK(std::abs(found.K2 + 0.5) < *found.errors[1]);
  CHECK(std::abs(found.K3 - 3) < *found.errors[2]);
}

TEST_CASE("accuracy: estimates fall as the lengths do, and grow with the scatter") {
  const Eigen::Vector3d domain(-0.1, 0.03, 0.4), extension(0.2, 0.01, 0.4);
  const auto coarse = refined(path({1, 0.7, 0.5}, domain, extension), coarse_spacing).at(0).at(0);
  const auto fine = refined(path({0.5, 0.35, 0.25}, domain, extension), coarse_spacing).at(0).at(0);
  auto scattered = path({0.5, 0.35, 0.25}, domain, extension);
  for (auto& srif : scattered[1].rows[0]) srif.K1 *= 1.03;
  for (std::size_t i = 0; i < 3; ++i) CHECK(*fine.errors[i] < 0.6 * *coarse.errors[i]);
  CHECK(*refined(scattered, coarse_spacing).at(0).at(0).errors[0] > 5 * *fine.errors[0]);
}

TEST_CASE("accuracy: three discretisations with all methods are needed") {
  const Eigen::Vector3d domain(-0.1, 0.03, 0.4), extension(0.2, 0.01, 0.4);
  CHECK(refined(path({1, 0.7}, domain, extension), coarse_spacing).empty());
  auto lost = path({1, 0.7, 0.5}, domain, extension);
  lost[1].rows[0].pop_back();
  CHECK(refined(lost, coarse_spacing).empty());
  CHECK_FALSE(largest_error({}, 1, coarse_spacing, 0).has_value());
}

TEST_CASE("accuracy: the error is that of the worst factor, relative to the largest of its tip") {
  auto found = refined(path({1, 0.7, 0.5}, {-0.1, 0.03, 0.4}, {0.2, 0.01, 0.4}), coarse_spacing);
  found[0][0].errors = {0.02, 0.01, 0.5};
  CHECK(*largest_error(found, 1, coarse_spacing, 0) == Approx(0.05 / 2));
  CHECK_FALSE(largest_error(found, 2, coarse_spacing, 0).has_value());
  auto weak = found[0][0];
  weak.tip = 1, weak.K1 = 0.001, weak.K2 = weak.K3 = 0, weak.errors = {0.001, 0, 0};
  found[0].push_back(weak);
  CHECK(*largest_error(found, 2, coarse_spacing, 0) == Approx(0.001 / (0.01 * 2)));
  CHECK(*largest_error(found, 2, coarse_spacing, 1000) == Approx(0.05 / (0.01 * 1000)));
}

TEST_CASE("accuracy: where no energy is released the fit tells the factors") {
  const Eigen::Vector3d domain(-0.1, 0.03, 0.4), extension(0.2, 0.01, 0.4);
  auto found = path({1, 0.7, 0.5}, domain, extension);
  for (auto& step : found)
    for (auto& srif : step.rows[0])
      if (srif.G) srif.G = -1e-9, srif.K1 = srif.K2 = srif.K3 = 0;
  const auto refined = post::refined(found, coarse_spacing).at(0).at(0);
  CHECK(refined.K1 == Approx(2));
  CHECK(refined.K3 == Approx(3));
}

TEST_CASE("accuracy: another method errs by its distance and by what the refinement may") {
  const auto best = refined(path({1, 0.7, 0.5}, {-0.1, 0.03, 0.4}, {0.2, 0.01, 0.4}), coarse_spacing).at(0).at(0);
  auto other = factors(SrifMethod::domain_integral, 2.1, -0.5, 3);
  refer_to(best, other, coarse_spacing);
  CHECK(*other.errors[0] == Approx(0.1 + *best.errors[0]));
  CHECK(*other.estimated_error >= *best.estimated_error);
}

TEST_CASE("accuracy: in motion factors are found at every time, and a time without a change is not taken for exact") {
  // K(t) goes through zero, its error too
  const Eigen::Vector3d K(2, -0.5, 3), domain(-0.1, 0.03, 0.4), extension(0.2, 0.01, 0.4);
  std::vector<AccuracyStep> path;
  for (const double size : {1.0, 0.7, 0.5}) {
    AccuracyStep moving = step(size, {0, 0, 0}, {0, 0, 0}, {0, 0, 0});
    for (const double time : {0.5, 1.0, -1.0})
      moving.rows.push_back(step(size, time * K, time * domain, time * extension).rows[0]);
    path.push_back(moving);
  }
  const auto found = refined(path, coarse_spacing);
  REQUIRE(found.size() == 4);
  CHECK(found[1][0].K1 == Approx(1).epsilon(1e-12));
  CHECK(found[3][0].K3 == Approx(-3).epsilon(1e-12));
  CHECK(found[0][0].K1 == 0);
  CHECK(*found[0][0].errors[0] > 0.5 * *found[2][0].errors[0]);
  CHECK(*found[2][0].errors[0] == Approx(*found[3][0].errors[0]));

  path.back().truncated = {0.01};
  const auto truncated = refined(path, coarse_spacing);
  for (std::size_t row = 0; row < 4; ++row)
    CHECK(*truncated[row][0].errors[1] == Approx(*found[row][0].errors[1] + 0.01 * 2));
  // judged by the largest factor at any time
  CHECK(*largest_error(found, 1, coarse_spacing, 0) ==
        Approx(std::max(*found[2][0].errors[0], coarse_spacing * *found[2][0].errors[2]) / 2));
}

TEST_CASE("accuracy: the best of a path is what is told, widened to what finer points tell") {
  const auto known = [](double K1, double error) {
    Srif srif = factors(SrifMethod::refinement, K1, 0, 0);
    srif.errors = {error, 0, 0};
    return std::vector<std::vector<Srif>>{{srif}};
  };
  // a finer discretisation that knows less does not take away what is known
  auto best = best_of({known(2, 0.1), known(2.02, 0.3)}, 1, coarse_spacing, 0);
  CHECK(best.rows[0][0].K1 == 2);
  CHECK(*best.error == Approx(0.05));
  // but where it is beyond the error, that was too small
  best = best_of({known(2, 0.1), known(2.15, 0.19)}, 1, coarse_spacing, 0);
  CHECK(best.rows[0][0].K1 == 2);
  CHECK(*best.rows[0][0].errors[0] == Approx(0.15));
  best = best_of({known(2, 0.1), known(3, 0.15)}, 1, coarse_spacing, 0);
  CHECK(best.rows[0][0].K1 == 3);
  // unless the later one knows much less
  best = best_of({known(2, 0.1), known(3, 0.25)}, 1, coarse_spacing, 0);
  CHECK(best.rows[0][0].K1 == 2);
  CHECK(*best.error == Approx(0.05));
  CHECK_FALSE(best_of({{}, {}}, 1, coarse_spacing, 0).error.has_value());
}
