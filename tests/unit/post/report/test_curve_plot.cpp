#include "post/report/curve_plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "cases/studies/comparison.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using post::Curve, post::CurvePlot, post::Line, post::Panel, post::ticks, post::thinned, post::to_svg;

namespace {

/// Whether every element is closed in its order and no bare < or & is left; no comments and no CDATA are known.
bool is_balanced(const std::string& xml) {
  static const std::regex tag(R"(<(/?)([a-zA-Z]+)((?:\s+[a-zA-Z0-9-]+="[^"<]*")*)\s*(/?)>)");
  static const std::regex entity("&(amp|lt|gt|quot|#39);");
  const std::string body = std::regex_replace(xml.substr(xml.find("?>") + 2), entity, "");
  std::vector<std::string> open;
  std::string rest;
  auto end = body.cbegin();
  for (std::sregex_iterator at(body.begin(), body.end(), tag), last; at != last; ++at) {
    rest.append(end, (*at)[0].first);
    end = (*at)[0].second;
    if ((*at)[1].length() > 0) {
      if (open.empty() || open.back() != (*at)[2].str()) return false;
      open.pop_back();
    } else if ((*at)[4].length() == 0) {
      open.push_back((*at)[2].str());
    }
  }
  rest.append(end, body.cend());
  return open.empty() && rest.find_first_of("<&") == std::string::npos;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

Panel panel(const std::vector<Curve>& curves) {
  Panel result{"time", "w", {}};
  for (const Curve& curve : curves) result.series.push_back({"computed", Line::computed, curve});
  return result;
}

Curve wave(std::size_t samples) {
  Curve result;
  for (std::size_t i = 0; i < samples; ++i) {
    result.t.push_back(static_cast<double>(i) / static_cast<double>(samples - 1));
    result.y.push_back(std::sin(40 * result.t.back()));
  }
  return result;
}

}  // namespace

TEST_CASE("ticks are round, evenly spaced, and cover their range") {
  const auto [low, high] = GENERATE(table<double, double>(
      {{0, 1}, {0, 0.0189}, {-3.7, 0.9}, {-0.05, 0.2}, {0.1, 0.7}, {1e5, 1.0001e5}, {-2e-83, 1e-83}, {-4e290, 7e290}}));
  const auto at = ticks(low, high);
  CAPTURE(low, high, at);
  REQUIRE(at.size() >= 3);
  CHECK(at.size() <= 9);
  const double step = at[1] - at[0];
  CHECK(at.front() <= low + 1e-9 * step);
  CHECK(at.front() > low - step);
  CHECK(at.back() >= high - 1e-9 * step);
  CHECK(at.back() < high + step);
  const double digit = step / std::pow(10.0, std::floor(std::log10(step) + 1e-6));
  const double nearest = digit < 1.5 ? 1 : digit < 3.5 ? 2 : 5;
  CHECK(digit == Approx(nearest).epsilon(1e-6));  // differences of ticks near 1e5 lose 5 of 16 digits
  for (std::size_t i = 0; i < at.size(); ++i) {
    CHECK(std::abs(at[i] - (at[0] + static_cast<double>(i) * step)) <= 1e-6 * step);
    CHECK(std::abs(at[i] / step - std::round(at[i] / step)) < 1e-4);
  }
}

TEST_CASE("zero is a tick without a sign, and a range without width has none") {
  const auto at = ticks(-1, 1);
  const auto zero = std::ranges::find(at, 0.0);
  REQUIRE(zero != at.end());
  CHECK_FALSE(std::signbit(*zero));
  CHECK_THROWS_AS(ticks(1, 1), std::invalid_argument);
  CHECK_THROWS_AS(ticks(0, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

TEST_CASE("markup in titles and labels is text") {
  CHECK(post::escaped("a < b & \"c\" > 'd'\x01") == "a &lt; b &amp; &quot;c&quot; &gt; &#39;d&#39;");
  CurvePlot plot{"</title><script>&", {panel({wave(10)})}};
  plot.panels[0].t_title = plot.panels[0].y_title = plot.panels[0].series[0].label = "<b> & </svg>";
  const std::string svg = to_svg(plot);
  CHECK(is_balanced(svg));
  CHECK(count(svg, "<script") == 0);
}

TEST_CASE("the check of balance finds what is not") {
  CHECK(is_balanced("<?xml?><a x=\"1\"><b/></a>"));
  CHECK_FALSE(is_balanced("<?xml?><a><b></a></b>"));
  CHECK_FALSE(is_balanced("<?xml?><a>1 < 2</a>"));
  CHECK_FALSE(is_balanced("<?xml?><a>1 & 2</a>"));
  CHECK_FALSE(is_balanced("<?xml?><a>"));
}

TEST_CASE("curves without width or without values are drawn without a division by zero") {
  constexpr double none = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  const Curve curve = GENERATE_COPY(values<Curve>({{},
                                                   {{0, 1, 2}, {0, 0, 0}},
                                                   {{0, 1, 2}, {-7, -7, -7}},
                                                   {{3}, {5}},
                                                   {{0, 1}, {none, infinite}},
                                                   {{0, 1, 2}, {1, none, 2}},
                                                   {{0, 1}, {0, 5e-324}},
                                                   {{0, 1}, {-1.7e308, 1.7e308}},
                                                   {{0, 1}, {1, 1 + 1e-15}}}));
  const std::string svg = to_svg({"flat", {panel({curve})}});
  CHECK(is_balanced(svg));
  CHECK(count(svg, "nan") == 0);
  CHECK(count(svg, "inf") == 0);
}

TEST_CASE("a plot without panels and a panel without series are documents") {
  CHECK(is_balanced(to_svg({})));
  CHECK(is_balanced(to_svg({"nothing", {Panel{}, panel({})}})));
}

TEST_CASE("a missing value leaves a gap") {
  const std::string svg =
      to_svg({"", {panel({{{0, 1, 2, 3, 4}, {0, 1, std::numeric_limits<double>::quiet_NaN(), 3, 4}}})}});
  const std::regex curve("class=\"curve computed\" d=\"(M[^\"]*)\"");
  std::smatch found;
  REQUIRE(std::regex_search(svg, found, curve));
  CHECK(count(found[1], "M") == 2);
  CHECK(count(found[1], "L") == 2);
}

TEST_CASE("numbered series are lines with marks, marks and rings are not joined") {
  Panel mixed = panel({});
  mixed.series = {{"a", Line::numbered, {{0, 1, 2}, {0, 1, 4}}, 0},
                  {"b", Line::marks, {{0, 1}, {2, 3}}, 1},
                  {"c", Line::rings, {{0.5}, {1}}}};
  const std::string svg = to_svg({"", {mixed}});
  CHECK(is_balanced(svg));
  CHECK(count(svg, "class=\"mark\"") == 3 + 2 + 2);  // and one each in the legend
  CHECK(count(svg, "class=\"ring\"") == 1 + 1);
  CHECK(count(svg, "class=\"curve numbered\"") == 1 + 1);
}

TEST_CASE("on a logarithmic scale equal factors are equal distances, and what is not positive is left out") {
  Panel powers = panel({{{1, 10, 100, 1000, -1, 0}, {1, 100, 10000, 0, 5, 5}}});
  powers.t_scale = powers.y_scale = post::Scale::logarithmic;
  const std::string svg = to_svg({"", {powers}});
  CHECK(is_balanced(svg));
  CHECK(count(svg, "nan") + count(svg, "inf") == 0);
  const std::regex path("class=\"curve computed\" d=\"M([0-9.]+) ([0-9.]+)L([0-9.]+) ([0-9.]+)L([0-9.]+) ([0-9.]+)\"");
  std::smatch found;
  REQUIRE(std::regex_search(svg, found, path));
  for (const int axis : {0, 1}) {
    const auto at = [&](int i) { return std::stod(found[2 * i + axis + 1]); };
    CHECK(at(1) - at(0) == Approx(at(2) - at(1)).margin(0.02));
  }
  powers.series[0].curve = {{-1, 0}, {1, 1}};
  CHECK(is_balanced(to_svg({"", {powers}})));
}

TEST_CASE("a series without a label is not in the legend, a range that is given is kept") {
  Panel alone = panel({wave(5)});
  alone.series[0].label.clear();
  CHECK(count(to_svg({"", {alone}}), "curve computed") == 1);
  alone.t_range = post::Range{-3, 7};
  CHECK(count(to_svg({"", {alone}}), ">\u22123<") == 1);
}

TEST_CASE("panels of the same range share the labels of time") {
  CHECK(count(to_svg({"", {panel({wave(9)}), panel({wave(9)})}}), ">time") == 1);
  CHECK(count(to_svg({"", {panel({wave(9)}), panel({{{0, 2}, {0, 1}}})}}), ">time") == 2);
}

TEST_CASE("thinning keeps the ends and every extreme that the width shows") {
  Curve curve = wave(50001);
  curve.y[12345] = 3;
  curve.y[12346] = -4;
  const Curve thin = thinned(curve, 700);
  CHECK(thin.t.size() == thin.y.size());
  CHECK(thin.t.size() <= 2 * 700 + 2);
  CHECK(std::ranges::is_sorted(thin.t));
  CHECK(thin.t.front() == curve.t.front());
  CHECK(thin.t.back() == curve.t.back());
  const auto extremes = [](const Curve& of) {
    std::vector<std::pair<double, double>> result(700, {9, -9});
    for (std::size_t i = 0; i < of.t.size(); ++i) {
      auto& [least, greatest] = result[std::min<std::size_t>(699, static_cast<std::size_t>(of.t[i] * 700))];
      least = std::min(least, of.y[i]);
      greatest = std::max(greatest, of.y[i]);
    }
    return result;
  };
  CHECK(extremes(thin) == extremes(curve));
  CHECK(thinned(wave(2000), 700).t.size() == 2000);
  CHECK(to_svg({"", {panel({wave(200000)})}}).size() < 60000);
}

TEST_CASE("a comparison has a panel for each quantity, its references under the computed curve") {
  const Curve curve = wave(20);
  cases::Comparison errors;
  errors.relative_rms = 0.0231;
  errors.peak_error = -0.0085;
  const auto plot = cases::plot({{"w", "w", errors, curve, curve},
                                 {"F1", "F1_J", errors, curve, curve},
                                 {"F1", "F1_paper_LS", errors, curve, curve},
                                 {"K1", "K1", errors, curve, curve},
                                 {"K3", "K3", errors, curve, curve}},
                                "plate");
  CHECK(plot.title == "plate");
  REQUIRE(plot.panels.size() == 3);
  CHECK(plot.panels[0].y_title == "deflection w");
  CHECK_THAT(plot.panels[2].y_title, Catch::EndsWith("K3"));
  const auto& factor = plot.panels[1].series;
  REQUIRE(factor.size() == 3);
  CHECK(factor[0].line == Line::reference);
  CHECK(factor[1].line == Line::second_reference);
  CHECK(factor[2].line == Line::computed);
  CHECK_THAT(factor[0].label, Catch::Contains("F1_J") && Catch::Contains("2.31 %") && Catch::Contains("\u22120.85 %"));
  CHECK(is_balanced(to_svg(plot)));
  const auto metres =
      cases::plot({{"w", "w", errors, curve, curve}, {"F1", "F1", errors, curve, curve}}, "plate", true);
  CHECK(metres.panels[0].y_title == "deflection w [m]");
  CHECK(metres.panels[0].t_title == "time [s]");
  CHECK(metres.panels[1].y_title == "normalized factor F1");
}

TEST_CASE("the title is that of the summary, or else the name of the folder") {
  const small_run::TemporaryFolder folder;
  const std::string name = folder.path().filename().string();
  CHECK(cases::title_of(folder.path()) == name);
  CHECK(cases::title_of(folder.path() / "") == name);
  std::ofstream(folder / "summary.json") << "{ broken";
  CHECK(cases::title_of(folder.path()) == name);
  std::ofstream(folder / "summary.json") << R"({"title": "Plate & crack"})";
  CHECK(cases::title_of(folder.path()) == "Plate & crack");
}
