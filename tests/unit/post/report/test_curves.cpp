#include "post/report/curves.hpp"

#include <cmath>

#include "post/factors/srif.hpp"
#include "post/files/table.hpp"
#include "post/report/curve_plot.hpp"
#include "tests/catch.hpp"

namespace {

post::Srif curve_factors(std::size_t tip, double K1, double K2, std::array<bool, 3> resolved) {
  post::Srif srif;
  srif.tip = tip, srif.method = post::SrifMethod::domain_integral, srif.K1 = K1, srif.K2 = K2, srif.K3 = 7,
  srif.resolved = resolved;
  return srif;
}

post::Table history() {
  return {{"time", "max_abs_w", "external_work", "strain_energy", "kinetic_energy", "fracture_energy"},
          {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, {0.5, 0.4, 3.0, 1.0, 2.0, 0.0}}};
}

}  // namespace

TEST_CASE("curves of a motion: a panel for what any tip has, gaps where a factor is not resolved") {
  auto other = curve_factors(0, 99, 99, {true, true, true});
  other.method = post::SrifMethod::series_fit;
  const std::vector<std::vector<post::Srif>> rows{
      {curve_factors(0, 1, 0, {true, true, false}), other, curve_factors(1, 2, 0, {true, true, false})},
      {curve_factors(0, -3, 0, {true, true, false}), other, curve_factors(1, 4, 0, {false, true, false})}};
  const auto plot = post::curves_of_motion("run", {0, 0.5}, rows, history(), true);
  REQUIRE(plot.panels.size() == 3);  // K2 is zero throughout, K3 nowhere resolved
  CHECK(plot.panels[0].y_title == "K1 [N m^1/2]");
  CHECK(plot.panels[0].t_title == "time [s]");
  REQUIRE(plot.panels[0].series.size() == 2);
  CHECK(plot.panels[0].series[0].label == "tip 0");
  CHECK(plot.panels[0].series[0].curve.y == std::vector<double>{1, -3});
  CHECK(plot.panels[0].series[1].curve.y[0] == 2);
  CHECK(std::isnan(plot.panels[0].series[1].curve.y[1]));
  CHECK(plot.panels[1].y_title == "largest |w| [m]");
  CHECK(plot.panels[2].series.size() == 3);  // no fracture energy
  CHECK_THAT(post::to_svg(plot), Catch::Contains("tip 1") && Catch::Contains("kinetic energy"));
}

TEST_CASE("curves of a growth: against the length of the cracks") {
  const post::Table growth{{"crack_length", "load_factor", "external_work", "strain_energy", "fracture_energy"},
                           {{0.4, 1.0, 0.0, 0.0, 0.0}, {0.5, 0.8, 2.0, 1.0, 1.0}}};
  const auto plot = post::curves_of_growth("run", growth, false);
  REQUIRE(plot.panels.size() == 2);
  CHECK(plot.panels[0].series[0].curve.t == std::vector<double>{0.4, 0.5});
  CHECK(plot.panels[0].series[0].curve.y == std::vector<double>{1, 0.8});
  CHECK(plot.panels[1].series.size() == 3);
}
