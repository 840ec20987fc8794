#include "post/report/html/comparison_page.hpp"

#include "post/figures/curve_plot.hpp"
#include "post/report/html/page.hpp"

namespace post {
namespace {

std::string numbers(const std::vector<double>& values) {
  constexpr int digits = 8;
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(json_number(value, digits));
  return json_list(texts);
}

std::string text_of(const Series& series) {
  const bool known = series.line == Line::reference || series.line == Line::second_reference ||
                     series.line == Line::third_reference || series.line == Line::rings;
  return json_object({{"label", json_text(series.label)},
                      {"reference", known ? "true" : "false"},
                      {"x", numbers(series.curve.t)},
                      {"y", numbers(series.curve.y)}});
}

}  // namespace

std::string comparison_page(const CurvePlot& plot, const std::string& table) {
  std::vector<std::string> panels;
  for (const auto& panel : plot.panels) {
    std::vector<std::string> series;
    for (const auto& one : panel.series) series.push_back(text_of(one));
    panels.push_back(
        json_object({{"x", json_text(panel.t_title)}, {"y", json_text(panel.y_title)}, {"series", json_list(series)}}));
  }
  return page(plot.title, json_object({{"kind", json_text("comparison")},
                                       {"title", json_text(plot.title)},
                                       {"table", json_text(table)},
                                       {"panels", json_list(panels)}}));
}

}  // namespace post
