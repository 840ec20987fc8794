#pragma once
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace post {

struct CurvePlot;

/// The files of post/report/html that make up a report, by their names: scripts, styles, the frame of the page. The
/// build makes them part of the program (cases/embed.cmake).
const std::map<std::string, std::string_view>& assets();

/// Members of a JSON object: names, and values that are JSON already.
using Members = std::vector<std::pair<std::string, std::string>>;

std::string json_object(const Members& members);
std::string json_list(const std::vector<std::string>& values);
/// Text as a JSON string; what is not UTF-8 is replaced.
std::string json_text(const std::string& text);
/// A number with so many digits; null where it is not finite.
std::string json_number(double value, int digits = 17);

/// The whole page: one file without references to others. `data`: JSON, which the page's scripts put into words,
/// drawings and plots.
std::string page(const std::string& title, const std::string& data);

/// The panels of a plot as a JSON list, for the scripts of a page; `log_x` and `log_y` where a scale is logarithmic.
std::string panels_json(const CurvePlot& plot);

/// The page of a comparison with reference curves: `table`, the error norms as they are printed, and the curves over
/// each other.
std::string comparison_page(const CurvePlot& plot, const std::string& table);

}  // namespace post
