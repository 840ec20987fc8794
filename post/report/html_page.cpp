#include "post/report/html_page.hpp"

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "post/report/curve_plot.hpp"
#include "post/report/svg.hpp"

namespace post {
namespace {

/// Scripts in the order in which they are read.
constexpr std::array scripts{"uplot/uPlot.iife.min.js",
                             "words.js",
                             "elements.js",
                             "plots.js",
                             "curves.js",
                             "plate.js",
                             "colours.js",
                             "fields.js",
                             "factors.js",
                             "results.js",
                             "studies.js",
                             "report.js"};
constexpr std::array styles{"uplot/uPlot.min.css", "report.css"};

std::string joined(const auto& names) {
  std::string text;
  for (const char* name : names) text.append(assets().at(name)).append("\n");
  return text;
}

/// The frame with texts where it says `{{name}}`, in one pass: what a text says is not looked at.
std::string filled(std::string_view frame, const std::map<std::string, std::string, std::less<>>& texts) {
  std::string result;
  for (auto at = frame.find("{{"); at != std::string_view::npos; at = frame.find("{{")) {
    const auto end = frame.find("}}", at);
    result.append(frame.substr(0, at)).append(texts.find(frame.substr(at + 2, end - at - 2))->second);
    frame.remove_prefix(end + 2);
  }
  return result.append(frame);
}

/// JSON in which no `<` is left, so that no browser takes any of it for markup.
std::string without_markup(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json)
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

}  // namespace

std::string json_object(const Members& members) {
  std::string text = "{";
  for (const auto& [name, value] : members)
    text.append(text.size() > 1 ? ",\n" : "").append(json_text(name)).append(":").append(value);
  return text + "}";
}

std::string json_list(const std::vector<std::string>& values) {
  std::string text = "[";
  for (const auto& value : values) text.append(text.size() > 1 ? "," : "").append(value);
  return text + "]";
}

std::string json_text(const std::string& text) {
  constexpr int compact = -1;
  return nlohmann::json(text).dump(compact, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string json_number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "null";
}

std::string page(const std::string& title, const std::string& data) {
  return filled(assets().at("page.html"), {{"title", escaped(title)},
                                           {"styles", joined(styles)},
                                           {"scripts", joined(scripts)},
                                           {"data", without_markup(data)}});
}

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

std::string panels_json(const CurvePlot& plot) {
  const auto is_log = [](Scale scale) { return scale == Scale::logarithmic ? "true" : "false"; };
  std::vector<std::string> panels;
  for (const auto& panel : plot.panels) {
    std::vector<std::string> series;
    for (const auto& one : panel.series) series.push_back(text_of(one));
    panels.push_back(json_object({{"x", json_text(panel.t_title)},
                                  {"y", json_text(panel.y_title)},
                                  {"log_x", is_log(panel.t_scale)},
                                  {"log_y", is_log(panel.y_scale)},
                                  {"series", json_list(series)}}));
  }
  return json_list(panels);
}

std::string comparison_page(const CurvePlot& plot, const std::string& table) {
  return page(plot.title, json_object({{"kind", json_text("comparison")},
                                       {"title", json_text(plot.title)},
                                       {"table", json_text(table)},
                                       {"panels", panels_json(plot)}}));
}

}  // namespace post
