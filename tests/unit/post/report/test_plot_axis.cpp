#include "post/report/svg.hpp"

#include <algorithm>
#include <cmath>

#include "tests/catch.hpp"

using post::plot_axis, post::Scale;

namespace {

std::vector<std::string> labels(const post::PlotAxis& axis) {
  std::vector<std::string> result;
  for (const auto& tick : axis.ticks)
    if (!tick.label.empty()) result.push_back(tick.label);
  return result;
}

}  // namespace

TEST_CASE("a logarithmic axis has equal steps for equal factors") {
  const auto axis = plot_axis({0.01, 100}, Scale::logarithmic, 5, true);
  CHECK(axis.share(0.01) == Approx(0).margin(1e-15));
  CHECK(axis.share(1) == Approx(0.5));
  CHECK(axis.share(100) == Approx(1));
}

TEST_CASE("labels of a logarithmic axis follow its number of decades") {
  const auto of = [](double low, double high) { return labels(plot_axis({low, high}, Scale::logarithmic, 5, true)); };
  CHECK(of(0.009, 120) == std::vector<std::string>{"0.01", "0.1", "1", "10", "100"});
  CHECK(of(0.15, 7) == std::vector<std::string>{"0.2", "0.5", "1", "2", "5"});
  CHECK(of(210, 390) == std::vector<std::string>{"250", "300", "350"});
  const auto many = of(1e-8, 1e12);
  CHECK(many.size() >= 5);
  CHECK(many.size() <= 8);
  CHECK_THAT(many.front(), Catch::Contains("10<tspan"));
  CHECK_THAT(of(150, 3e6).back(), Catch::Contains("10<tspan") && Catch::Contains(">6<"));
}

TEST_CASE("every logarithmic range has two labels or more, and all ticks lie in it") {
  for (const double low : {1e-5, 0.003, 0.017, 1.0, 1.9, 9.5, 400.0})
    for (const double factor : {1.1, 1.5, 3.0, 6.4, 9.0, 40.0, 180.0, 1e3, 1e5, 1e9}) {
      CAPTURE(low, factor);
      const auto axis = plot_axis({low, low * factor}, Scale::logarithmic, 5, true);
      CHECK(labels(axis).size() >= 2);
      CHECK(labels(axis).size() <= 10);
      CHECK(std::ranges::is_sorted(axis.ticks, {}, &post::Tick::value));
      for (const auto& tick : axis.ticks) CHECK(axis.share(tick.value) == Approx(0.5).margin(0.5 + 1e-6));
    }
}

TEST_CASE("a linear axis covers its range with ticks or ends with it") {
  const auto covering = plot_axis({0.1, 0.78}, Scale::linear, 5, true);
  CHECK(covering.range == post::Range{0, 0.8});
  const auto tight = plot_axis({0.1, 0.78}, Scale::linear, 5, false);
  CHECK(tight.range == post::Range{0.1, 0.78});
  CHECK(tight.ticks.front().value > 0.1);
  CHECK(plot_axis({0, 0.004}, Scale::linear, 5, true).power == -3);
  CHECK(post::axis_title("a < b", covering) == "a &lt; b");
  CHECK_THAT(post::axis_title("w", plot_axis({0, 0.004}, Scale::linear, 5, true)), Catch::Contains("\u22123"));
}
