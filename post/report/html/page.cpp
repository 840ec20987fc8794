#include "post/report/html/page.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "post/figures/svg.hpp"
#include "post/report/html/assets.hpp"

namespace post {
namespace {

/// In the order in which they are read.
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

/// Puts `text` where the frame says `{{name}}`.
void fill(std::string& frame, const std::string& name, const std::string& text) {
  const std::string mark = "{{" + name + "}}";
  const auto at = frame.find(mark);
  if (at == std::string::npos) throw std::logic_error("the frame of the report has no place for " + name);
  frame.replace(at, mark.size(), text);
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

std::string page(const std::string& title, const std::string& data) {
  std::string text(assets().at("page.html"));
  fill(text, "title", escaped(title));
  fill(text, "styles", joined(styles));
  fill(text, "scripts", joined(scripts));
  fill(text, "data", without_markup(data));  // last: the data may say anything
  return text;
}

}  // namespace post
