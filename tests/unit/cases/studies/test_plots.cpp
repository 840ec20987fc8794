#include "cases/studies/study_plots.hpp"

#include "tests/catch.hpp"
#include "tests/unit/post/study_of_powers.hpp"

using post::Line, post::Scale, cases::study_plots, study_of_powers::row, study_of_powers::study;

namespace {

const cases::StudyTitles titles{"plate", {"h [m]", "spacing [m]"}, true};

std::vector<std::string> names(const std::map<std::string, post::CurvePlot>& plots) {
  std::vector<std::string> result;
  for (const auto& plot : plots) result.push_back(plot.first);
  return result;
}

}  // namespace

TEST_CASE("a study has plots of errors and of quantities against axes of numbers") {
  CHECK(names(study_plots(study(), titles)) ==
        std::vector<std::string>{"K1_against_h.svg", "K1_against_spacing.svg", "error_against_points.svg",
                                 "error_against_seconds.svg", "w_against_h.svg", "w_against_spacing.svg"});
  auto words = study();
  for (auto& each : words.rows) each.labels[0] = each.labels[0] == "0.1" ? "thin" : "thick";
  CHECK(names(study_plots(words, titles)).size() == 4);
  CHECK(study_plots({{"a"}, {}}, titles).empty());
}

TEST_CASE("errors are drawn in percent, a line for each combination of the other axes") {
  const auto plot = study_plots(study(), titles).at("error_against_seconds.svg");
  CHECK(plot.title == "plate");
  REQUIRE(plot.panels.size() == 2);
  CHECK(plot.panels[0].y_title == "|error| of w at centre [%]");
  CHECK(plot.panels[0].t_title == "run time [s]");
  CHECK(plot.panels[0].t_scale == Scale::logarithmic);
  CHECK(plot.panels[0].y_scale == Scale::logarithmic);
  CHECK(plot.panels[0].t_range == plot.panels[1].t_range);
  const auto& series = plot.panels[0].series;
  REQUIRE(series.size() == 2);
  CHECK(series[0].label == "h 0.1 (order 2.00)");
  CHECK(series[1].label == "h 0.2 (order 1.00)");
  CHECK(series[0].line == Line::numbered);
  CHECK(series[1].number == plot.panels[1].series[1].number);
  CHECK_THAT(series[0].curve.y, Catch::Matchers::Approx(std::vector<double>{1, 0.25, 0.0625}));
  CHECK_THAT(series[0].curve.t, Catch::Matchers::Approx(std::vector<double>{1, 8, 64}));
  const auto points = study_plots(study(), titles).at("error_against_points.svg");
  CHECK_THAT(points.panels[0].series[0].curve.t, Catch::Matchers::Approx(std::vector<double>{400, 1600, 6400}));
}

TEST_CASE("without a refinement errors are marks, alike along the last axis") {
  auto table = study();
  for (auto& each : table.rows) each.spacing = each.horizon = 0.1;
  const auto panel = study_plots(table, titles).at("error_against_seconds.svg").panels[0];
  REQUIRE(panel.series.size() == 2);
  CHECK(panel.series[0].line == Line::marks);
  CHECK(panel.series[0].label == "h 0.1");
  CHECK(panel.series[0].curve.t.size() == 3);
}

TEST_CASE("values are drawn over their axis with each reference once") {
  auto table = study();
  table.rows[8].computed.reset();
  const auto panel = study_plots(table, titles).at("w_against_h.svg").panels.at(0);
  CHECK(panel.t_title == "h [m]");
  CHECK(panel.y_title == "deflection w at centre [m]");
  CHECK(panel.t_scale == Scale::linear);
  REQUIRE(panel.series.size() == 4);
  CHECK(panel.series[0].label == "spacing 0.1");
  CHECK(panel.series[0].curve.t == std::vector<double>{0.1, 0.2});
  CHECK(panel.series[1].curve.t == std::vector<double>{0.1});
  CHECK(panel.series[3].label == "reference");
  CHECK(panel.series[3].line == Line::rings);
  CHECK(panel.series[3].curve.t == std::vector<double>{0.1, 0.2});
  CHECK(panel.series[3].curve.y == std::vector<double>{4, -2});
}

TEST_CASE("methods are told apart by their names where there are several") {
  auto table = study();
  const auto first = table.rows;
  for (auto each : first) {
    if (each.quantity != "K1") continue;
    each.method = "other";
    table.rows.push_back(each);
  }
  const auto plot = study_plots(table, titles).at("error_against_points.svg");
  REQUIRE(plot.panels.size() == 2);
  CHECK(plot.panels[0].series[0].label == "h 0.1 (order 2.00)");
  CHECK(plot.panels[1].series[0].label == "h 0.1, first method (order 1.50)");
  CHECK(plot.panels[1].series[2].label == "h 0.1, other (order 1.50)");
}

TEST_CASE("against a curve the peaks are drawn, against the finest run no references") {
  auto table = study();
  for (auto& each : table.rows)
    if (each.quantity == "w")
      each.rms_error = 0.1;
    else
      each.against_finest = true;
  const auto plots = study_plots(table, titles);
  CHECK(plots.at("w_against_h.svg").panels[0].y_title == "peak of deflection w at centre [m]");
  for (const auto& series : plots.at("K1_against_h.svg").panels[0].series) CHECK(series.line != Line::rings);
}

TEST_CASE("labels are numbers or words") {
  CHECK(cases::number_of("0.1") == 0.1);
  CHECK(cases::number_of("-1e-3") == -1e-3);
  for (const char* word : {"", "0.1 m", "thin", "inf", "nan", "1,5"}) CHECK_FALSE(cases::number_of(word));
}

TEST_CASE("a numeric axis over more than a factor of 20 is logarithmic") {
  auto table = study();
  for (auto& each : table.rows)
    if (each.labels[1] == "0.025") each.labels[1] = "0.001";
  CHECK(study_plots(table, titles).at("w_against_spacing.svg").panels[0].t_scale == Scale::logarithmic);
}
