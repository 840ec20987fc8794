#include "cases/studies/curve_norms.hpp"

#include <cmath>
#include <numbers>

#include "tests/catch.hpp"

using cases::Comparison, post::Curve;

namespace {

std::vector<double> times(double from, double to, std::size_t count) {
  std::vector<double> t(count);
  for (std::size_t i = 0; i < count; ++i)
    t[i] = from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1);
  return t;
}

std::vector<double> sine(const std::vector<double>& t, double amplitude, double shift) {
  std::vector<double> y;
  for (const double instant : t) y.push_back(amplitude * std::sin(instant - shift));
  return y;
}

/// Compares curves that can be compared.
Comparison compare(const std::vector<double>& t, const std::vector<double>& y, const std::vector<double>& reference_t,
                   const std::vector<double>& reference_y) {
  return std::get<Comparison>(cases::compare(t, y, reference_t, reference_y));
}

constexpr double period = 2 * std::numbers::pi;

}  // namespace

TEST_CASE("a shifted sine differs by 2 sin(shift / 2)") {
  constexpr double shift = 0.1;
  const auto t = times(0, period, 4001), reference_t = times(0, period * 2999 / 3000, 3000);  // one whole period
  const auto result = compare(t, sine(t, -1, shift), reference_t, sine(reference_t, -1, 0));
  CHECK(result.samples == 3000);
  // measured 9e-8, from the linear interpolation between samples
  CHECK(result.relative_rms == Approx(2 * std::sin(shift / 2)).epsilon(1e-6));
  CHECK(result.peak_error == Approx(0).margin(1e-6));
}

TEST_CASE("a scaled curve has the same relative error everywhere") {
  const auto t = times(0, 3, 301);
  const auto result = compare(t, sine(t, -1.05, 0), t, sine(t, -1, 0));
  CHECK(result.relative_rms == Approx(0.05));
  CHECK(result.peak_error == Approx(0.05));
  double squares = 0;  // of the differences
  for (const double instant : t) squares += std::pow(0.05 * std::sin(instant), 2);
  CHECK(result.rms_of_peak == Approx(std::sqrt(squares / 301) / std::sin(1.57)));
  CHECK(result.peak_computed == Approx(-1.05).epsilon(1e-4));
  CHECK(result.peak_reference == Approx(-1).epsilon(1e-4));
  CHECK(result.time_of_peak_computed == Approx(period / 4).margin(0.01));
  CHECK(result.time_of_peak_reference == result.time_of_peak_computed);
}

TEST_CASE("only the common range counts") {
  const auto result = compare({1, 2, 3}, {1, 2, 3}, {0, 1.5, 2.5, 9}, {100, 1.5, 2.5, 100});
  CHECK(result.samples == 2);
  CHECK(result.relative_rms == Approx(0).margin(1e-15));
  CHECK(result.peak_reference == 2.5);
  CHECK(result.peak_computed == 3);
}

TEST_CASE("curves that cannot be compared: the reason instead") {
  const auto reason = [](const Curve& computed, const Curve& reference) {
    return std::get<std::string>(cases::compare(computed.t, computed.y, reference.t, reference.y));
  };
  CHECK(reason({{0, 1}, {0}}, {{0, 1}, {0, 1}}) == "computed: 2 times, 1 values");
  CHECK(reason({{0, 1}, {0, 1}}, {{}, {}}) == "reference: no samples");
  CHECK(reason({{1, 0}, {0, 1}}, {{0, 1}, {0, 1}}) == "computed: time goes back");
  CHECK_THAT(reason({{0, 1}, {0, 1}}, {{1, 2}, {0, 1}}), Catch::StartsWith("1 samples in common"));
  CHECK(reason({{0, 1}, {0, 1}}, {{0, 1}, {0, 0}}) == "the reference is zero where the curves overlap");
}

TEST_CASE("the shift of a sine is found, whatever the sampling, the size and the offset") {
  const auto t = times(0, 2.5 * period, 1777), reference_t = times(0, 2.5 * period, 1201);
  for (const double late : {-0.9, -0.01, 0.0, 0.3, 1.2}) {
    auto y = sine(t, -1.7, late);
    for (double& value : y) value += 0.4;
    const auto result = compare(t, y, reference_t, sine(reference_t, -1, 0));
    REQUIRE(result.shift);
    CHECK(*result.shift == Approx(late).margin(2e-4));
    CHECK(*result.relative_shift() == Approx(*result.shift / (2.5 * period)));
  }
}

TEST_CASE("norms of broken lines are exact between their samples") {
  // the difference of t and 2 t - 1 is 1 - t; at 0.5 the computed curve has a sample that the reference has not
  const auto result = compare({0, 0.5, 1}, {-1, 0, 1}, {0, 1}, {0, 1});
  CHECK(result.relative_l2 == Approx(1));  // both integrals are 1/3
  CHECK(result.relative_max == Approx(1));
  CHECK(result.relative_rms == Approx(1));
  const auto hat = compare({0, 0.5, 1}, {1, 3, 1}, {0, 1}, {1, 1});  // the hat is between the times of the reference
  CHECK(hat.relative_rms == 0);
  CHECK(hat.relative_max == Approx(2));
  CHECK(hat.relative_l2 == Approx(std::sqrt(4.0 / 3)));
  CHECK(hat.peak_error == Approx(2));
  CHECK(hat.peak_time_error == Approx(0.5));
  CHECK_FALSE(hat.shift);  // a constant reference
}

TEST_CASE("the common range is stated: the reference shorter or longer than the run") {
  const auto t = times(0, 4, 401), longer = times(0, 8, 801), shorter = times(1, 3, 201);
  const auto part = compare(t, sine(t, 1.1, 0), longer, sine(longer, 1, 0));
  CHECK(part.from == 0);
  CHECK(part.to == 4);
  CHECK(part.covered == Approx(0.5));
  CHECK(part.relative_l2 == Approx(0.1));
  CHECK(part.relative_max == Approx(0.1));
  const auto all = compare(t, sine(t, 1.1, 0), shorter, sine(shorter, 1, 0));
  CHECK(all.from == 1);
  CHECK(all.to == 3);
  CHECK(all.covered == 1);
  CHECK(all.samples == 201);
}

TEST_CASE("measures are named, relative and without sign") {
  const auto t = times(0, 3, 301);
  const auto found = cases::measures(compare(t, sine(t, -0.9, 0), t, sine(t, -1, 0)));
  const std::vector<std::string> names{"l2", "max", "peak", "peak_time", "shift"};
  REQUIRE(found.size() == names.size());
  for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i].first == names[i]);
  for (std::size_t i = 0; i < 3; ++i) CHECK(found[i].second == Approx(0.1));
  CHECK(found[3].second == 0);
  CHECK(found[4].second == Approx(0).margin(1e-6));
}
