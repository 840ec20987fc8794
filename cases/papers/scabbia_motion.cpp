// Scabbia, Zaccariotto, Galvanetto, surface nodes in motion: a bar with a hump against its series.

#include <fmt/format.h>

#include "cases/papers/bodies/moving_bar.hpp"
#include "cases/papers/paper_rows.hpp"

namespace cases {
namespace {

namespace bb = boundary_bodies;

struct MotionWay {
  std::string name;
  bb::MovingBar way;
};

const std::vector<MotionWay>& motion_ways() {
  constexpr double without_bias = 100 / 99.5;  // m / (m - 1/2)
  static const std::vector<MotionWay> all{
      {"no corrections", {.ends = bb::BarEnds::bare}},
      {"surface nodes, linear", {.ends = bb::BarEnds::surface}},
      {"surface nodes, quadratic", {.ends = bb::BarEnds::surface, .order = 2}},
      {"surface nodes, linear, kernel m/(m-1/2)", {.ends = bb::BarEnds::surface, .kernel = without_bias}},
      {"multipliers (2021), linear", {.ends = bb::BarEnds::multiplied}}};
  return all;
}

post::Curve curve_of_nodes(const Eigen::VectorXd& u) {
  post::Curve curve;
  for (int i = 0; i < u.size(); i += 5) curve.t.push_back((i + 0.5) * bb::moving_bar_spacing), curve.y.push_back(u[i]);
  return curve;
}

}  // namespace

PaperResults scabbia_motion(const std::filesystem::path&) {
  const std::vector<int> steps{250, 500, 600, 750, 1000, 1500, 2500};  // 50, 100, 120, 150, 200, 300, 500 us
  const std::vector<int> drawn{500, 1000, 2500};
  PaperResults results;
  std::vector<post::Panel> panels;
  for (const int step : drawn) {
    post::Panel panel{"x [m]", fmt::format("u at {:g} us [m]", step * bb::moving_bar_step * 1e6), {}};
    panel.series.push_back({.label = "series (7)",
                            .line = post::Line::reference,
                            .curve = curve_of_nodes(bb::moving_bar_series(step * bb::moving_bar_step))});
    panels.push_back(panel);
  }
  for (std::size_t number = 0; number < motion_ways().size(); ++number) {
    const auto& [name, way] = motion_ways()[number];
    const ProcessorWatch watch;
    const auto instants = bb::moving_bar(way, steps);
    for (const auto& instant : instants) {
      const double time = instant.step * bb::moving_bar_step;
      const Eigen::VectorXd exact = bb::moving_bar_series(time);
      Eigen::Index place = 0;
      (instant.u - exact).cwiseAbs().maxCoeff(&place);
      const std::string item = fmt::format("Fig. 3, {}, {:g} us", name, 1e6 * time);
      results.add(watch, item,
                  fmt::format("u at the worst node, x = {:.4f} m [m]", (double(place) + 0.5) * bb::moving_bar_spacing),
                  instant.u[place], exact[place], "series (7)");
      results.add(watch, item, "rms error over the rms of the series [-]", instant.mean, 0, "series (7)");
      if (number > 2) continue;  // the curves that the paper draws, and the quadratic one
      for (std::size_t i = 0; i < drawn.size(); ++i)
        if (drawn[i] == instant.step)
          panels[i].series.push_back(
              {.label = name, .line = post::Line::plain, .curve = curve_of_nodes(instant.u), .number = number});
    }
  }
  results.panels = panels;
  return results;
}

}  // namespace cases
