#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "post/files/table.hpp"
#include "post/studies/compare.hpp"
#include "tests/unit/post/small_run.hpp"

using post::compare, post::Table, small_run::TemporaryFolder;

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

TEST_CASE("curves that cannot be compared are refused") {
  CHECK_THROWS_WITH(compare({0, 1}, {0}, {0, 1}, {0, 1}), "computed: 2 times, 1 values");
  CHECK_THROWS_WITH(compare({0, 1}, {0, 1}, {}, {}), "reference: no samples");
  CHECK_THROWS_WITH(compare({1, 0}, {0, 1}, {0, 1}, {0, 1}), "computed: time goes back");
  CHECK_THROWS_WITH(compare({0, 1}, {0, 1}, {1, 2}, {0, 1}), "1 samples in common");
  CHECK_THROWS_WITH(compare({0, 1}, {0, 1}, {0, 1}, {0, 0}), "the reference is zero where the curves overlap");
}

namespace {

/// Two probes and two tips by two methods; only what is to be chosen is t times a simple number.
void write_results(const TemporaryFolder& folder) {
  Table probes{{"time", "probe", "x", "y", "w", "theta_x", "theta_y"}, {}};
  Table srifs{{"time", "tip", "x", "y", "method", "K1", "F1"}, {}};
  for (const double t : {0.0, 1.0, 2.0}) {
    probes.rows.push_back({t, "edge", 1.0, 0.0, 99.0, 99.0, 99.0});
    probes.rows.push_back({t, "tip", 0.1, 0.0, 1.1 * t, 0.0, t});
    for (const double tip : {0.0, 1.0}) {
      const double x = tip == 0 ? -0.1 : 0.1;
      srifs.rows.push_back({t, tip, x, 0.0, "first", tip * 2 * t, tip * 3 * t});
      srifs.rows.push_back({t, tip, x, 0.0, "second", 99.0, 99.0});
    }
  }
  post::write_csv(folder / "probes.csv", probes);
  post::write_csv(folder / "srif.csv", srifs);
}

}  // namespace

TEST_CASE("a results folder is compared in every quantity that the reference knows") {
  const TemporaryFolder folder;
  write_results(folder);
  Table reference{{"t", "w", "theta_x", "K1", "F1_paper_LS", "F1", "F1_J", "w_f"}, {}};
  for (const double t : {0.0, 0.5, 1.5}) reference.rows.push_back({t, t, -0.0, 2 * t, 1.5 * t, 2.0 * t, 3 * t, t});
  post::write_csv(folder / "reference.csv", reference);

  const auto rows = compare(folder.path(), folder / "reference.csv");
  std::vector<std::string> names;
  std::vector<double> errors;
  for (const auto& row : rows) {
    names.push_back(row.quantity + ":" + row.reference);
    errors.push_back(row.comparison.relative_rms);
  }
  CHECK(names == std::vector<std::string>{"w:w", "F1:F1_J", "F1:F1_paper_LS", "F1:F1", "K1:K1"});
  const std::vector<double> expected{0.1, 0, 1, 0.5, 0};
  CHECK_THAT(errors, Catch::Approx(expected).margin(1e-12));

  const std::string text = post::to_text(rows);
  CHECK(std::count(text.begin(), text.end(), '\n') == 6);
  CHECK_THAT(text, Catch::Contains("F1_paper_LS") && Catch::Contains("10.000 %"));
}

TEST_CASE("a reference without curves is refused") {
  const TemporaryFolder folder;
  write_results(folder);
  post::write_csv(folder / "static.csv", {{"r", "K1"}, {{0.1, 1.0}}});
  CHECK_THROWS_WITH(compare(folder.path(), folder / "static.csv"), Catch::Contains("no column t"));
  post::write_csv(folder / "other.csv", {{"t", "pressure"}, {{0.1, 1.0}}});
  CHECK_THROWS_WITH(compare(folder.path(), folder / "other.csv"), Catch::Contains("no curve in common"));
}
