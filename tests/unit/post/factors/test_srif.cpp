#include "post/factors/srif.hpp"
#include "tests/catch.hpp"

using namespace post;

namespace {

constexpr double fine_spacing = 0.5;

Srif with(double K1, double K2, double K3) {
  Srif result;
  result.K1 = K1, result.K2 = K2, result.K3 = K3;
  return result;
}

}  // namespace

TEST_CASE("srif: the largest factor counts K3 by its stress at the face") {
  CHECK(largest_factor(with(-3, 2, 4), fine_spacing) == 3);
  CHECK(largest_factor(with(1, 2, -6), fine_spacing) == 3);
}

TEST_CASE("srif: coarser results make errors larger, never smaller") {
  auto srif = with(10, 0, 2);
  srif.errors = {0.5, 0.1, {}};
  srif.estimated_error = 0.05;
  widen(srif, with(9, 0.05, 8), fine_spacing);
  CHECK(*srif.errors[0] == 1);
  CHECK(*srif.errors[1] == 0.1);
  CHECK(*srif.errors[2] == 6);
  CHECK(*srif.estimated_error == Approx(0.3));  // of K3 h
  auto zero = with(0, 0, 0);
  widen(zero, with(0, 0, 0), fine_spacing);
  CHECK_FALSE(zero.estimated_error);  // of nothing there is no share
}

TEST_CASE("srif: coarser results make errors in the plane larger, and leave nothing of a factor beyond a tenth") {
  auto srif = with(0, 0, 0), coarser = with(0, 0, 0);  // of tension alone
  srif.membrane = MembraneFactors{{10, 2}, {0.5, {}}, {true, true}, {}};
  widen(srif, coarser, fine_spacing);
  CHECK(*srif.membrane->errors[0] == 0.5);  // coarser points have no such factors
  coarser.membrane = MembraneFactors{{9.2, 0.5}, {}, {true, true}, {}};
  widen(srif, coarser, fine_spacing);
  CHECK(*srif.membrane->errors[0] == Approx(0.8));
  CHECK(*srif.membrane->errors[1] == Approx(1.5));
  CHECK(srif.membrane->resolved == std::array{true, false});
  CHECK_FALSE(srif.estimated_error);
}

TEST_CASE("srif: what is added to errors is added once to each that is known") {
  auto srif = with(10, 0, 2);
  srif.errors = {0.5, {}, 1.0};
  srif.estimated_error = 0.05;
  widen(srif, 0.2, fine_spacing);
  CHECK(*srif.errors[0] == Approx(0.7));
  CHECK_FALSE(srif.errors[1]);
  CHECK(*srif.errors[2] == Approx(1.4));
  CHECK(*srif.estimated_error == Approx(0.07));
}

TEST_CASE("srif: the difference between two formulations is symmetric, and counts in the error") {
  auto one = with(10, 1, 0), other = with(8, 1, 2);
  const auto kept = one;
  compare_with(one, other, "galerkin", fine_spacing), compare_with(other, kept, "ordinary", fine_spacing);
  CHECK(one.second->difference == Approx(0.2));
  CHECK(other.second->difference == Approx(0.2));
  CHECK(*one.estimated_error >= one.second->difference);
  CHECK(*one.errors[2] == 2);
  CHECK(one.second->K1 == 8);
}

TEST_CASE("srif: normalised by a moment, or by the moment of a pressure") {
  SrifOptions options;
  auto srif = with(6, -3, 8);
  normalize(srif, options, fine_spacing);
  CHECK_FALSE(srif.F1);
  options.normalize = Normalization{{}, {}, 1.5};
  options.half_length = 4;
  normalize(srif, options, fine_spacing);
  CHECK(*srif.F1 == Approx(2));
  CHECK(*srif.F2 == Approx(-1));
  CHECK(*srif.F3 == Approx(4 / 3.0));
  options.normalize = Normalization{6, 1, {}};  // p (W/2)^2 = 1.5
  normalize(srif, options, fine_spacing);
  CHECK(*srif.F1 == Approx(2));
}

TEST_CASE("srif: every method has a name of its own, by which it is found") {
  for (int i = 0; i <= int(SrifMethod::refinement); ++i) {
    const auto method = SrifMethod(i);
    CHECK(srif_method(name_of(method)) == method);
  }
  CHECK(std::string(name_of(SrifMethod::series_fit)) == "series_fit");
  CHECK_FALSE(srif_method("guesswork"));
  CHECK_FALSE(srif_method(""));
}

TEST_CASE("the recommended factors of a tip are the first that it has") {
  std::vector<post::Srif> srifs(5);
  for (std::size_t i = 0; i < srifs.size(); ++i) srifs[i].tip = i / 2;
  const auto first = post::recommended(srifs);
  CHECK(first == std::vector<const post::Srif*>{&srifs[0], &srifs[2], &srifs[4]});
  CHECK(post::recommended({}).empty());
}
